#pragma once
#include <random>
#include <string>

#include "model/state.hpp"
#include "physics/physics.hpp"

namespace hibi::test {

/// Concrete of the thesis, section 3.2, without a break strain.
inline Material concrete() {
    return {.name = "concrete", .density = 2300, .youngs_modulus = 2.1e8, .poissons_ratio = 0.3};
}

/// A plate of columns x rows particles, one corner at the origin.
inline Model<2> plate(int columns, int rows, double spacing, const Material& material = concrete(),
                      Assumption assumption = Assumption::plane_stress,
                      const std::vector<Notch<2>>& notches = {}) {
    Model<2> model;
    model.materials = {material};
    model.assumption = assumption;
    add_body<2>(model, {.name = "plate",
                        .shape = {Box<2>{{0, 0}, {columns * spacing, rows * spacing}}},
                        .spacing = spacing});
    connect<2>(model, notches);
    return model;
}

template <class Condition>
std::vector<int> where(const Model<2>& model, Condition condition) {
    std::vector<int> selected;
    for (int i = 0; i < model.particles.count(); ++i)
        if (condition(model.particles.reference_position[i])) selected.push_back(i);
    return selected;
}

/// Every seventh bond, as if it had broken at t = 0.
inline void break_every_seventh(State<2>& state) {
    for (std::size_t b = 0; b < state.broken_at.size(); b += 7) state.broken_at[b] = 0;
}

/// Turned by `angle` about the origin, then disturbed at random by up to `noise` spacings; a fixed seed.
inline void turn_and_shake(const Model<2>& model, State<2>& state, double angle, double noise,
                           unsigned seed = 1) {
    std::mt19937 random(seed);
    Mat<2> R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        const auto shake = [&] {
            return noise * model.particles.spacing[i] * (static_cast<double>(random()) / 0x1p31 - 1);
        };
        const double dx = shake(), dy = shake();
        state.displacement[i] = R * X - X + Vec<2>(dx, dy);
    }
}

inline Load pull(const Model<2>&, std::vector<int> particles, const Vec<2>& total, double ramp) {
    Load load;
    load.name = "pull";
    load.particles = std::move(particles);
    load.ramp = {ramp};
    load.share.assign(load.particles.size(), Vec3::UnitX() / static_cast<double>(load.particles.size()));
    load.value = {Field(total.x()), Field(total.y()), Field(0)};
    load.direction = to_3d<2>(total.normalized());
    return load;
}

}  // namespace hibi::test
