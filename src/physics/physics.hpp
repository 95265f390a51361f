#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/field.hpp"
#include "base/vec.hpp"
#include "elasticity/elastic_law.hpp"

namespace hibi {

/// Components held at their place from the first moment on.
struct Hold {
    std::string name{};
    std::vector<int> particles{};
    std::array<bool, 3> axes{};
};

/// Grows from 0 to 1 over `duration` seconds, then stays.
struct Ramp {
    double duration = 0;
    double operator()(double t) const { return duration > 0 && t < duration ? t / duration : 1.0; }
};

/// One [[load]]. What it does to its particles is one of the kinds; the others stay empty.
struct Load {
    enum class Kind {
        force,     ///< value: total force (N), shared by `share`
        pressure,  ///< value[0]: pressure (Pa) against the nodal areas in `share`; positive pushes into the
                   ///< body
        displacement,  ///< value: prescribed displacement (m) of the components in `driven`
        velocity       ///< value: prescribed velocity (m/s) of the components in `driven`
    };
    std::string name{};
    Kind kind = Kind::force;
    std::vector<int> particles{};
    std::vector<Vec3>
        share;  ///< force: x component is the particle's fraction; pressure: area vector A_i (m^2)
    std::array<Field, 3> value{};
    std::array<bool, 3> driven{};
    Ramp ramp{};
    bool primary = false;
    bool no_fail = false;  ///< bonds between two of its particles never break

    /// Unit vector along which load and displacement are reported.
    Vec3 direction = Vec3::UnitX();

    bool prescribes_motion() const { return kind == Kind::displacement || kind == Kind::velocity; }
};

struct Gravity {
    Vec3 acceleration = Vec3::Zero();  ///< (m/s^2)
};

/// Mass-proportional: each particle feels -c m v. Exactly one of rate and ratio is set.
struct Damping {
    std::optional<double> rate{};   ///< c (1/s)
    std::optional<double> ratio{};  ///< of the first mode: c = 2 ratio omega_1
};

/// Equilibrium from load step to load step, in place of motion. Time is only what ramps and the film go by.
struct Statics {
    double duration = 1;     ///< in which all load steps are made (s)
    int load_steps = 50;     ///< of equal length
    bool sequential = true;  ///< bonds break one by one, and what is left moves on in between; else all that
                             ///< are beyond their limits in equilibrium break together

    double step() const { return duration / load_steps; }
    /// Time that passes from one break to the next while the load stands still (s): a film shows them one
    /// after the other.
    double pause() const { return step() / 500; }
};

/// Everything that acts on a model. What is absent costs nothing.
struct Physics {
    Elasticity elasticity = Elasticity::moment_matched;
    std::vector<Hold> holds{};
    std::vector<Load> loads{};
    std::optional<Gravity> gravity{};
    std::optional<Damping> damping{};
    std::optional<Statics> statics{};          ///< absent: explicit steps in time
    std::optional<double> time_step{};         ///< (s); chosen when absent
    std::optional<double> time_step_factor{};  ///< of the stable limit; 0.8, or 0.5 where bonds can break
};

}  // namespace hibi
