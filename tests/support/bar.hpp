#pragma once
#include "simulation/simulation.hpp"
#include "support/plates.hpp"

namespace hibi::test {

/// A bar held on the left and pulled apart by moving its right end.
inline SimulationIn<2> bar(double break_strain, double velocity, double ramp = 0.2) {
    Material m = test::concrete();
    m.break_strain = break_strain;
    Model<2> model = plate(12, 3, 1, m);
    Physics physics;
    physics.holds = {{"clamp", where(model, [](const Vec<2>& X) { return X.x() < 1; }), {true, true, false}}};
    Load grip;
    grip.name = "grip";
    grip.kind = Load::Kind::velocity;
    grip.particles = where(model, [](const Vec<2>& X) { return X.x() > 11; });
    grip.driven = {true, false, false};
    grip.value = {Field(velocity), Field(0), Field(0)};
    grip.ramp = {ramp};
    physics.loads = {grip};
    physics.damping = Damping{.ratio = 0.1};
    return {model, physics};
}

}  // namespace hibi::test
