#include "picture_tests/junit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "record/files.hpp"
#include "report/html.hpp"

namespace hibi {

namespace {

/// XML has no way to write most control characters.
std::string attribute(const std::string& text) {
    std::string clean;
    for (const char c : text) clean += c == '\n' || c == '\t' ? ' ' : c;
    std::erase_if(clean, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    return escaped(clean);
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases) {
    const auto failures = std::ranges::count_if(cases, [](const JunitCase& c) { return !c.failure.empty(); });
    const auto errors = std::ranges::count_if(cases, [](const JunitCase& c) { return !c.error.empty(); });
    double seconds = 0;
    for (const JunitCase& c : cases) seconds += c.seconds;
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
        attribute(suite), cases.size(), failures, errors, seconds);
    for (const JunitCase& c : cases) {
        text += fmt::format("<testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", attribute(c.group),
                            attribute(c.name), c.seconds);
        if (!c.failure.empty())
            text += fmt::format("><failure message=\"{}\"/></testcase>\n", attribute(c.failure));
        else if (!c.error.empty())
            text += fmt::format("><error message=\"{}\"/></testcase>\n", attribute(c.error));
        else
            text += "/>\n";
    }
    return text + "</testsuite>\n</testsuites>\n";
}

void write_junit(const std::filesystem::path& file, const std::string& suite,
                 const std::vector<JunitCase>& cases) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    write_file(file, junit_xml(suite, cases));
}

}  // namespace hibi
