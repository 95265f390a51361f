#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hibi {

/// One case of a JUnit report.
struct JunitCase {
    std::string group, name;
    double seconds = 0;
    std::string failure{};  ///< what differs; empty: it passed
    std::string error{};    ///< why it could not be judged
};

/// JUnit XML as servers for continuous integration read it.
std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases);
void write_junit(const std::filesystem::path& file, const std::string& suite,
                 const std::vector<JunitCase>& cases);

}  // namespace hibi
