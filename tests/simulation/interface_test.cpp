#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "breaking/limits.hpp"
#include "elasticity/elastic_coefficients.hpp"
#include "elasticity/elastic_law.hpp"
#include "elasticity/frequency.hpp"
#include "elasticity/mixed_bonds.hpp"
#include "simulation/simulation.hpp"
#include "statics/equilibrium.hpp"
#include "support/plain_bonds.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

constexpr int soft = 0, stiff = 1;

std::vector<Material> materials(double contrast, double soft_nu = 0, double stiff_nu = 0) {
    return {{.name = "soft", .density = 1000, .youngs_modulus = 1e6, .poissons_ratio = soft_nu},
            {.name = "stiff", .density = 1000, .youngs_modulus = 1e6 * contrast, .poissons_ratio = stiff_nu}};
}

/// A plate of 1 m particles, soft where is_soft(X) says so.
template <class IsSoft>
Model<2> glued(int columns, int rows, std::vector<Material> materials, IsSoft is_soft,
               double influence = 2.1) {
    Model<2> model;
    model.materials = std::move(materials);
    model.influence = influence;
    add_body<2>(model, {.name = "plate",
                        .shape = {Box<2>{{0, 0}, {1.0 * columns, 1.0 * rows}}},
                        .spacing = 1,
                        .material = stiff});
    connect<2>(model, {});
    for (int i = 0; i < model.particles.count(); ++i)
        if (is_soft(model.particles.reference_position[i])) model.particles.material[i] = soft;
    return model;
}

/// Between two stiff blocks of 10 columns, a soft layer.
Model<2> layered(int layer, int rows, std::vector<Material> materials, double influence = 2.1) {
    return glued(
        20 + layer, rows, std::move(materials),
        [&](const Vec<2>& X) { return X.x() > 10 && X.x() < 10 + layer; }, influence);
}

/// Settles under `applied` with the first column held. Returns the mean motion of the last column along the
/// force.
double motion(const Model<2>& model, State<2>& state, const Vec<2>& force) {
    std::vector<std::array<bool, 3>> held(model.particles.count());
    std::vector<Vec<2>> applied(model.particles.count(), Vec<2>::Zero());
    double right = 0;
    for (const Vec<2>& X : model.particles.reference_position) right = std::max(right, X.x());
    const std::vector<int> end = test::where(model, [&](const Vec<2>& X) { return X.x() > right - 0.1; });
    for (const int i : test::where(model, [](const Vec<2>& X) { return X.x() < 1; })) held[i] = {true, true};
    for (const int i : end) applied[i] = force / static_cast<double>(end.size());
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    state = initial_state(model);
    Equilibrium<2> equilibrium(model, *law, state, held);
    EXPECT_TRUE(equilibrium.find(state, {applied, {}}).found);
    double sum = 0;
    for (const int i : end) sum += state.displacement[i].dot(force.normalized());
    return sum / static_cast<double>(end.size());
}
double motion(const Model<2>& model, const Vec<2>& force) {
    State<2> state;
    return motion(model, state, force);
}

struct Layer {
    int columns;
    double contrast, influence, tolerance;
};
void PrintTo(const Layer& l, std::ostream* out) { *out << l.columns << " columns, 1:" << l.contrast; }

class SoftLayer : public testing::TestWithParam<Layer> {};

// Springs in series. Ten columns high, so that the ends of the interface, where particles have free surfaces
// as well, count with.
TEST_P(SoftLayer, StretchesAsASpringInSeriesWithWhatItIsGluedTo) {
    const auto [columns, contrast, influence, tolerance] = GetParam();
    const Model<2> model = layered(columns, 10, materials(contrast), influence);
    const double stress = 1e2;
    // The columns that are held and pulled have errors of their own, those of the stiff bar.
    const Model<2> bar = layered(columns, 10, materials(1));
    const double exact =
        motion(bar, {10 * stress / contrast, 0}) + columns * stress / 1e6 * (1 - 1 / contrast);
    EXPECT_NEAR(motion(model, {10 * stress, 0}) / exact, 1, tolerance);
}
INSTANTIATE_TEST_SUITE_P(Tension, SoftLayer,
                         testing::Values(Layer{1, 1e3, 2.1, 0.015}, Layer{2, 1e3, 2.1, 0.01},
                                         Layer{4, 1e3, 2.1, 0.005}, Layer{8, 1e3, 2.1, 0.003},
                                         Layer{1, 1e4, 2.1, 0.015}, Layer{4, 1e4, 2.1, 0.005},
                                         Layer{1, 1e6, 2.1, 0.015}, Layer{1, 10, 2.1, 0.015},
                                         Layer{1, 3, 2.1, 0.01}, Layer{2, 1e3, 3.1, 0.015},
                                         Layer{4, 1e3, 3.1, 0.01}, Layer{4, 1e3, 1.5, 0.01}));

struct Patch {
    const char* name;
    double contrast, soft_nu, stiff_nu;
    int layer;              ///< columns of the soft layer; 0: half and half
    bool diagonal;          ///< the interface lies at 45 degrees to the rows
    double energy, stress;  ///< relative errors allowed, of tension across and along and shear alike
};
void PrintTo(const Patch& p, std::ostream* out) { *out << p.name; }

class InterfacePatch : public testing::TestWithParam<Patch> {
 protected:
    static constexpr int width = 24;
    const Vec<2> across_ = GetParam().diagonal ? Vec<2>(std::sqrt(0.5), std::sqrt(0.5)) : Vec<2>(1, 0);
    const Vec<2> along_{-across_.y(), across_.x()};
    const int columns_ = width + GetParam().layer % 2;
    const double row_ = GetParam().diagonal ? std::sqrt(0.5) : 1;
    /// Distance across from the middle, of the sides of what is soft.
    double low_ = -1e3, high_ = 0;

    InterfacePatch() {
        const Patch& p = GetParam();
        if (p.layer) low_ = -0.5 * p.layer * row_, high_ = low_ + p.layer * row_;
        if (p.diagonal && p.layer % 2 == 0) low_ += 0.5 * row_, high_ += 0.5 * row_;
        model_ = glued(columns_, columns_, materials(p.contrast, p.soft_nu, p.stiff_nu),
                       [&](const Vec<2>& X) { return is_soft(X); });
    }
    double depth(const Vec<2>& X) const { return (X - Vec<2>(columns_ / 2.0, columns_ / 2.0)).dot(across_); }
    bool is_soft(const Vec<2>& X) const { return depth(X) > low_ && depth(X) < high_; }
    /// From the middle, of what has one value in the soft and another one in the stiff part.
    double integral(double to, const std::array<double, 2>& value) const {
        const auto soft_length = [&](double x) { return std::clamp(x, low_, high_); };
        const double in_soft = soft_length(to) - soft_length(0);
        return value[soft] * in_soft + value[stiff] * (to - in_soft);
    }

    struct Exact {
        std::array<double, 2> stretch{}, shear{};  ///< of each material, across and along the interface
        double along = 0;
    };
    /// Particles near the border are held where the exact solution has them; judges all others, in a strip
    /// across the middle.
    void judge(const Exact& exact, const char* what) {
        const Model<2>& model = model_;
        State<2> state = initial_state(model);
        std::array<Mat<2>, 2> stress;
        std::array<double, 2> density{};  // of energy
        for (const int k : {soft, stiff}) {
            const double mu = shear_modulus(model.materials[k]);
            const double lambda = lame_lambda(model.materials[k], model.assumption);
            Mat<2> strain;
            strain << exact.stretch[k], exact.shear[k] / 2, exact.shear[k] / 2, exact.along;
            stress[k] = 2 * mu * strain + lambda * strain.trace() * Mat<2>::Identity();
            density[k] = (stress[k].transpose() * strain).trace() / 2;
        }
        std::vector<std::array<bool, 3>> held(model.particles.count());
        for (int i = 0; i < model.particles.count(); ++i) {
            const Vec<2>& X = model.particles.reference_position[i];
            const double d = depth(X), l = (X - Vec<2>(columns_ / 2.0, columns_ / 2.0)).dot(along_);
            state.displacement[i] =
                integral(d, exact.stretch) * across_ + (exact.along * l + integral(d, exact.shear)) * along_;
            const double border = std::min({X.x(), X.y(), columns_ - X.x(), columns_ - X.y()});
            if (border < 4) held[i] = {true, true};
        }
        const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
        Equilibrium<2> equilibrium(model, *law, state, held);
        ASSERT_TRUE(
            equilibrium.find(state, {std::vector<Vec<2>>(model.particles.count(), Vec<2>::Zero()), {}}).found);
        Mat<2> turned;
        turned << across_, along_;
        double sum = 0, exact_sum = 0, worst = 0;
        for (int i = 0; i < model.particles.count(); ++i) {
            const Vec<2>& X = model.particles.reference_position[i];
            const double l = (X - Vec<2>(columns_ / 2.0, columns_ / 2.0)).dot(along_);
            // whole periods of the rows, whichever way they run
            if (l < -2.2 || l > 2.05 || std::abs(depth(X)) > width / 2 - 4) continue;
            const int k = model.particles.material[i];
            const LocalState<2> local = law->local(state, i);
            sum += local.energy;
            exact_sum += density[k];
            const Mat<2> error = turned.transpose() * local.stress * turned - stress[k];
            worst = std::max(worst, error.cwiseAbs().maxCoeff() / stress[k].cwiseAbs().maxCoeff());
        }
        EXPECT_NEAR(sum / exact_sum, 1, GetParam().energy) << what;
        EXPECT_LE(worst, GetParam().stress) << what;
    }

    Model<2> model_;
};

TEST_P(InterfacePatch, TensionAcrossAndAlongAndShearKeepTheirStresses) {
    const auto mu = [&](int k) { return shear_modulus(model_.materials[k]); };
    const auto lambda = [&](int k) { return lame_lambda(model_.materials[k], model_.assumption); };
    Exact across, shear, along{.along = 1e-6};
    for (const int k : {soft, stiff}) {
        across.stretch[k] = 1 / (2 * mu(k) + lambda(k));
        shear.shear[k] = 1 / mu(k);
        along.stretch[k] = -lambda(k) / (2 * mu(k) + lambda(k)) * along.along;
    }
    judge(across, "tension across");
    judge(shear, "shear");
    judge(along, "tension along");
}
INSTANTIATE_TEST_SUITE_P(Table, InterfacePatch,
                         testing::Values(Patch{"nu 0", 1000, 0, 0, 0, false, 0.001, 0.05},
                                         Patch{"1:1000", 1000, 0.3, 0.3, 0, false, 0.006, 0.06},
                                         Patch{"1:10", 10, 0.3, 0.3, 0, false, 0.004, 0.05},
                                         Patch{"1:3", 3, 0.3, 0.3, 0, false, 0.002, 0.04},
                                         Patch{"soft one wider", 10, 0.45, 0, 0, false, 0.002, 0.07},
                                         Patch{"stiff one wider", 10, 0, 0.45, 0, false, 0.012, 0.08},
                                         Patch{"one particle thick", 1000, 0.3, 0.3, 1, false, 0.008, 0.36},
                                         Patch{"two particles thick", 1000, 0.3, 0.3, 2, false, 0.01, 0.09},
                                         Patch{"at 45 degrees", 1000, 0.3, 0.3, 0, true, 0.015, 0.18}));

Model<2> inclusion() {
    std::vector<Material> of = materials(50, 0.4, 0.2);
    return glued(9, 8, of, [](const Vec<2>& X) { return (X - Vec<2>(4, 4.5)).norm() < 2.2; });
}

TEST(Interface, ForcesAndTangentAreTheDerivativesOfOneEnergyWithBrokenBonds) {
    const Model<2> model = inclusion();
    State<2> state = initial_state(model);
    test::break_every_seventh(state);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched, state);
    test::turn_and_shake(model, state, 0.7, 0.02);
    const Eigen::MatrixXd K = tangent(model, state);
    law->forces(state);
    const std::vector<Vec<2>> force = state.force;
    double scale = 0;
    for (const Vec<2>& f : force) scale = std::max(scale, f.norm());
    const double h = 1e-4;
    for (int i = 0; i < model.particles.count(); i += 3) {
        for (int a = 0; a < 2; ++a) {
            double& u = state.displacement[i][a];
            const double keep = u;
            Eigen::VectorXd slope = Eigen::VectorXd::Zero(K.rows());
            constexpr std::array<double, 4> at{-2, -1, 1, 2}, factor{1, -8, 8, -1};
            double derivative = 0;
            for (int k = 0; k < 4; ++k) {
                u = keep + at[k] * h;
                derivative += factor[k] * law->energy(state) / (12 * h);
                law->forces(state);
                for (int j = 0; j < model.particles.count(); ++j)
                    slope.segment<2>(2 * j) += factor[k] / (12 * h) * state.force[j];
            }
            u = keep;
            EXPECT_NEAR(-derivative, force[i][a], 1e-7 * scale) << i << " " << a;
            EXPECT_LT((slope + K.col(2 * i + a)).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff());
        }
    }
}

TEST(Interface, TurnedBodyFeelsNoForceAndLoopsGiveTheBitsOfThePlainOne) {
    const Model<2> model = inclusion();
    State<2> state = initial_state(model);
    test::break_every_seventh(state);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched, state);
    const ElasticCoefficients coefficients = elastic_coefficients(model);
    test::turn_and_shake(model, state, 1.3, 0);
    law->forces(state);
    for (const Vec<2>& f : state.force) EXPECT_LE(f.norm(), 1e-12 * 5e7);
    EXPECT_LE(law->energy(state), 1e-20 * 5e7);
    test::turn_and_shake(model, state, 1.3, 0.05);
    law->forces(state);
    EXPECT_TRUE(state.force == test::plain_forces(model, state, coefficients));
    const std::vector<LocalState<2>> states = law->local(state, 0, model.particles.count());
    double energy = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        energy += states[i].energy;
        EXPECT_TRUE(states[i].stress.isApprox(law->local(state, i).stress, 1e-12)) << i;
    }
    EXPECT_NEAR(energy / law->energy(state), 1, 1e-12);
}

TEST(Interface, MaterialsOfOneShearModulusChangeNoBit) {
    std::vector<Material> alike = materials(1, 0.3, 0.3);
    alike[soft].density = 7;
    Model<2> model = layered(3, 8, alike);
    const ElasticCoefficients coefficients = elastic_coefficients(model);
    const BondWeights s = moment_matched_weights(model);
    EXPECT_TRUE(mixed_bonds(model).empty());
    EXPECT_TRUE(coefficients.gauges.empty());
    EXPECT_TRUE(coefficients.s.forward == s.forward && coefficients.s.backward == s.backward);
}

TEST(Interface, BondThroughAThinLayerIsAChainOfAllThatItPasses) {
    const Model<2> model = layered(1, 5, materials(100));
    const double mu = shear_modulus(model.materials[soft]);
    int through = 0, into = 0;
    for (const MixedBond& mixed : mixed_bonds(model)) {
        const Vec<2>& r0 = model.bond_vectors[mixed.bond];
        if (r0 == Vec<2>(2, 0) &&
            mixed.first_length == 0.5) {  // half of it in the layer, a quarter at each end
            ++through;
            EXPECT_NEAR(mixed.modulus, mu / (0.5 + 0.5 / 100), 1e-9 * mu);
            EXPECT_EQ(mixed.materials, (std::vector<int>{soft, stiff}));
        } else if (std::abs(r0.x()) == 1) {
            ++into;
            EXPECT_NEAR(mixed.modulus, mu / (0.5 + 0.5 / 100), 1e-9 * mu);
            EXPECT_EQ(mixed.first_length, 0.5);
        }
    }
    EXPECT_EQ(through, 5);
    EXPECT_EQ(into, 2 * (5 + 4 + 4));
}

// Swung to rest: 20 periods at a damping ratio of 0.5 leave less than 1e-20 of the swing.
TEST(Interface, ExplicitStepsComeToRestWhereStaticsDo) {
    Model<2> model = layered(2, 8, materials(10, 0.3, 0.3));
    Physics physics;
    physics.holds = {{"clamp", test::where(model, [](const Vec<2>& X) { return X.x() < 1; }), {true, true}}};
    const std::vector<int> end = test::where(model, [](const Vec<2>& X) { return X.x() > 21; });
    physics.loads = {test::pull(model, end, {1e3, -3e3}, 0)};
    physics.damping = Damping{.ratio = 0.5};
    std::vector<std::array<bool, 3>> held(model.particles.count());
    for (const int i : physics.holds[0].particles) held[i] = {true, true};
    const double duration = 20 * 2 * 3.14159 / first_frequency(model, held);
    SimulationIn<2> moving(model, physics);
    while (moving.time() < duration) moving.step();
    EXPECT_LE(std::abs(moving.energies().sum() - moving.energies().work), 1e-3 * moving.energies().work);
    physics.damping.reset();
    physics.statics = Statics{.duration = 1, .load_steps = 1};
    SimulationIn<2> still(model, physics);
    still.step();
    const double most = still.state().displacement[end.front()].norm();
    ASSERT_GT(most, 0);
    for (int i = 0; i < model.particles.count(); ++i)
        EXPECT_LE((moving.state().displacement[i] - still.state().displacement[i]).norm(),
                  1e-8 * most);
}

// The mean strain of a bond that is half in the stiff part is half of that in its soft part.
TEST(Interface, LayerBreaksAtTheStrainOfItsMaterial) {
    for (const int columns : {1, 2, 4}) {
        std::vector<Material> of = materials(1e4);
        of[soft].break_strain = 0.01;
        of[stiff].break_strain = 0.01;
        const Model<2> model = layered(columns, 10, of);
        for (const double share : {0.9, 1.15}) {
            State<2> pulled;
            motion(model, pulled, {10 * 1e6 * 0.01 * share, 0});
            const BreakLimits limits = break_limits(model, break_strains(model, {}));
            const auto law = make_elastic_law<2>(model, Elasticity::moment_matched, limits);
            EXPECT_EQ(law->forces(pulled).empty(), share < 1) << columns << " columns at " << share;
        }
    }
}

TEST(Interface, ThesisVariantActsInSeriesAsWell) {
    const int rows = 30;  // its surfaces are stiff or soft by themselves
    const auto stretch = [&](int layer, double contrast) {
        const Model<2> model = layered(layer, rows, materials(contrast));
        State<2> state = initial_state(model);
        const auto law = make_elastic_law<2>(model, Elasticity::thesis);
        law->start(state, std::vector<std::array<bool, 3>>(model.particles.count()));
        // uniform stress in series, as bilinear displacements: inner particles are at rest
        for (int i = 0; i < model.particles.count(); ++i) {
            const double x = model.particles.reference_position[i].x();
            const double in_layer = std::clamp(x - 10, 0.0, 1.0 * layer);
            state.displacement[i] = {1e-6 * (in_layer + (x - in_layer) / contrast), 0};
        }
        law->forces(state);
        double worst = 0;
        for (int i = 0; i < model.particles.count(); ++i) {
            const Vec<2>& X = model.particles.reference_position[i];
            if (std::min({X.x(), X.y(), 20 + layer - X.x(), rows - X.y()}) > 4)
                worst = std::max(worst, state.force[i].norm());
        }
        return worst;
    };
    for (const int layer : {1, 2, 4})
        for (const double contrast : {3.0, 1000.0}) EXPECT_LE(stretch(layer, contrast), 1e-6 * 1e6 * 1e-6);
}

}  // namespace
}  // namespace hibi
