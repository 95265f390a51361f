#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/verification.hpp"
#include "studies/verify_cases.hpp"

namespace hibi {

struct VerifyOptions {
    std::vector<std::string> cases{};  ///< by id; empty: all
    std::string variant{};             ///< "default" or "thesis"; empty: both
    bool quick = false;                ///< coarse resolutions only
    bool list = false;                 ///< print the cases instead
    double goals = 1;                  ///< goals are multiplied by this
    std::filesystem::path folder = "out/verify";
    bool json = false;  ///< print verify.json instead of the table
    bool quiet = false;
};

/// `hibi verify`: runs scenes with known answers at several resolutions, for both elastic laws, and writes
/// verify.json, verify.csv, speed_vs_error.svg, speed_vs_error.png and verify.html. Returns the exit status:
/// 1 where a goal was missed. Throws std::invalid_argument for a case that is not known.
int verify_command(const VerifyOptions& options);

/// One case at one resolution.
VerifyRow verify_row(const VerifyCase& the_case, const VerifyResolution& resolution, Elasticity variant);

}  // namespace hibi
