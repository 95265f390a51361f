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
    double goals = 1;                  ///< goals are multiplied by this
    std::filesystem::path folder = "out/verify";
    bool quiet = false;
};

struct Verification {
    std::vector<VerifyRow> rows;
    double seconds = 0;   ///< wall time of all runs
    bool passes() const;  ///< no run failed, and no goal was missed
};

/// Runs scenes with known answers at several resolutions, for both elastic laws, and writes verify.json,
/// verify.csv, speed_vs_error.svg, speed_vs_error.png and verify.html. Throws std::invalid_argument for a
/// case that is not known.
Verification run_verification(const VerifyOptions& options);

/// One case at one resolution.
VerifyRow verify_row(const VerifyCase& the_case, const VerifyResolution& resolution, Elasticity variant);

}  // namespace hibi
