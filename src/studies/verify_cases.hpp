#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/run_monitor.hpp"
#include "scene/read.hpp"

namespace hibi {

/// What a case may need of one moment of a run.
struct VerifyObservation {
    HistoryRow row;
    double modal_displacement = 0;  ///< see ModalDisplacement (s)
    double angular_momentum = 0;  ///< (kg m^2/s)
};

/// A finished run, as a case judges it.
struct VerifyRun {
    Scene scene;
    Events events;
    std::vector<VerifyObservation> observations;  ///< from the start to the end

    double parameter(const std::string& name) const;  ///< a value of [params], SI
    /// Column displacement.NAME of the last observation (m).
    double displacement(const std::string& load) const;
};

struct VerifyResult {
    double measured = 0, reference = 0;
    double error = 0;  ///< relative to the reference unless the case says otherwise; never negative
};

struct VerifyResolution {
    double value = 0;              ///< of the case's parameter
    std::optional<double> goal{};  ///< largest error that passes, of the default variant
    bool quick = false;            ///< belongs to `--quick`
    bool thesis = true;            ///< also with the thesis variant, which takes several times as long
};

/// A scene whose answer is known.
struct VerifyCase {
    std::string id, title, group;
    std::string scene;                          ///< built-in scene
    std::string parameter;                      ///< of [params], that is refined
    std::string quantity, unit;                 ///< what is measured
    std::string reference;                      ///< in words, with its source
    std::vector<VerifyResolution> resolutions;  ///< coarse to fine
    /// Judges the runs of one resolution: one, or as many as `overrides` has entries.
    std::function<VerifyResult(const std::vector<VerifyRun>&)> judge;
    std::vector<Overrides> overrides{{}};
    int observations = 250;  ///< moments of a run that are observed
};

/// All cases, in the order in which they are run.
const std::vector<VerifyCase>& verify_cases();

}  // namespace hibi
