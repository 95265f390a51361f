#pragma once
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "elasticity/tangent.hpp"
#include "elasticity/weights.hpp"
#include "support/plates.hpp"

namespace hibi::test {

/// A strip of width 1 m, lower left corner at the origin, with a straight crack along x at half its height;
/// unit stress pulls at the top and at the bottom. E = 1 Pa.
struct StripCase {
    int across = 40;   ///< particles across the width
    double angle = 0;  ///< of the lattice (degrees)
    double nu = 0.3;
    double influence = 2.1;  ///< r_e / l0
    double shift_x = 0;      ///< of the crack's tip (l0)
    double shift_y =
        0.354;  ///< of the crack: halfway between two planes of particles at 0 and at 45 degrees (l0)
    bool centre = false;  ///< a crack of 0.3 of the width in its middle instead of at the left edge
    double height = 2;    ///< (m)
    double jitter = 0;
    std::uint64_t seed = 1;
    Assumption assumption = Assumption::plane_stress;

    double spacing() const { return 1.0 / across; }
    /// From the edge, or half of a centre crack (m).
    double crack() const { return (centre ? 0.15 : 0.3) + shift_x * spacing(); }
    Vec<2> tip() const { return {(centre ? 0.5 : 0) + crack(), height / 2 + shift_y * spacing()}; }
    /// K_I / sigma (sqrt m). Tada, Paris, Irwin, The Stress Analysis of Cracks Handbook: single edge notch,
    /// least squares fit of Gross 1964 and Brown 1966 (0.5 % for a/b <= 0.6, height at least twice the
    /// width); centre crack, secant of Feddersen with Tada's factor (0.1 %).
    double intensity() const {
        const double pi = std::numbers::pi, a = crack();
        const double ratio = centre ? 2 * a : a;
        const double F = centre ? (1 - 0.025 * std::pow(ratio, 2) + 0.06 * std::pow(ratio, 4)) /
                                      std::sqrt(std::cos(pi * ratio / 2))
                                : 1.12 - 0.231 * ratio + 10.55 * std::pow(ratio, 2) -
                                      21.72 * std::pow(ratio, 3) + 30.39 * std::pow(ratio, 4);
        return F * std::sqrt(pi * a);
    }
};

inline Model<2> cracked_strip(const StripCase& c) {
    Model<2> model;
    model.materials = {{.name = "unit", .density = 1, .youngs_modulus = 1, .poissons_ratio = c.nu}};
    model.influence = c.influence;
    model.assumption = c.assumption;
    add_body<2>(model, {.name = "strip",
                        .shape = {Box<2>{{0, 0}, {1, c.height}}},
                        .spacing = c.spacing(),
                        .lattice = {c.angle * std::numbers::pi / 180, c.jitter, c.seed}});
    const Vec<2> tip = c.tip();
    connect<2>(model, {{.name = "crack", .points = {{c.centre ? 1 - tip.x() : -1, tip.y()}, tip}}});
    return model;
}

/// Second derivative of the energy of particle p by the displacements of `members`, p first, then the other
/// ends of its bonds (N/m); broken bonds carry nothing. The slow, obvious counterpart of tangent.
inline Eigen::MatrixXd stiffness_of_particle(const Model<2>& model, const State<2>& state,
                                             const BondWeights& weights, int p,
                                             std::vector<int>& members) {
    const Bonds& bonds = model.bonds;
    const Particles<2>& particles = model.particles;
    const Material& material = model.materials[particles.material[p]];
    const double V = particles.volume[p], two_mu = 2 * shear_modulus(material);
    members = {p};
    const int count = bonds.start[p + 1] - bonds.start[p];
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 + 2 * count, 2 + 2 * count);
    Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(2, 2 + 2 * count);  // of tr A and A21 - A12
    double m = 0;
    for (int k = 0; k < count; ++k) {
        const int b = bonds.bonds_of[bonds.start[p] + k], j = bonds.other(b, p), at = 2 + 2 * k;
        members.push_back(j);
        if (!state.is_intact(b)) continue;
        const double s = bonds.first[b] == p ? weights.forward[b] : weights.backward[b];
        const Vec<2> r0 = particles.reference_position[j] - particles.reference_position[p];
        const double spring = s / r0.squaredNorm();
        Mat<2> slope;
        slope << r0.x(), r0.y(), -r0.y(), r0.x();
        slope *= spring / V;
        Z.block<2, 2>(0, at) += slope;
        Z.block<2, 2>(0, 0) -= slope;
        m += s / V;
        for (int axis = 0; axis < 2; ++axis) {
            K(axis, axis) += two_mu * spring;
            K(at + axis, at + axis) += two_mu * spring;
            K(axis, at + axis) -= two_mu * spring;
            K(at + axis, axis) -= two_mu * spring;
        }
    }
    if (m == 0) return K;
    const Vec<2> M(lame_lambda(material, model.assumption) * V, -two_mu * V / m);
    return K + Z.transpose() * M.asDiagonal() * Z;
}

/// Breaking bond by bond, the load set anew each time: small strains, no dynamics. The body beyond a few
/// spacings from the crack's tip never changes, so it enters once, as the compliance of the particles near
/// the tip.
class CrackGrowth {
 public:
    /// Particles less than `ahead` spacings before, `behind` behind and `beside` beside the tip may be
    /// touched.
    explicit CrackGrowth(const StripCase& c, double ahead = 9, double behind = 7, double beside = 8)
        : case_(c),
          model_(cracked_strip(c)),
          state_(initial_state(model_)),
          weights_(moment_matched_weights(model_)) {
        const Particles<2>& particles = model_.particles;
        const int n = particles.count();
        const Vec<2> tip = c.tip();
        near_.assign(n, -1);
        for (int i = 0; i < n; ++i) {
            const Vec<2> X = (particles.reference_position[i] - tip) / c.spacing();
            if (X.x() > ahead || X.x() < -behind || std::abs(X.y()) > beside) continue;
            near_[i] = static_cast<int>(list_.size());
            list_.push_back(i);
        }

        load_ = Eigen::VectorXd::Zero(2 * n);
        const std::vector<Vec<2>> areas = nodal_areas(model_);
        const double depth = 2 * c.influence * c.spacing();
        for (int i = 0; i < n; ++i) {
            const double y = particles.reference_position[i].y();
            if (std::min(y, c.height - y) < depth) load_[2 * i + 1] = areas[i].y();
        }
        const int local = 2 * static_cast<int>(list_.size());
        const auto solver = factors();
        at_rest_ = restricted(solver->solve(load_));
        compliance_.resize(local, local);
        Eigen::VectorXd unit = Eigen::VectorXd::Zero(2 * n);
        for (int k = 0; k < local; ++k) {
            const int dof = 2 * list_[k / 2] + k % 2;
            unit[dof] = 1;
            compliance_.col(k) = restricted(solver->solve(unit));
            unit[dof] = 0;
        }
    }

    const Model<2>& model() const { return model_; }

    struct Break {
        int bond;
        double load;    ///< at which it breaks, as K_I of the initial crack (Pa sqrt m)
        Vec<2> middle;  ///< of the bond, from the initial tip (l0)
    };

    /// Breaks what reaches its limit first, again and again, until the crack has grown by `growth` spacings
    /// or a no bond is left that may. `limit` gives the strain at which a bond of that length (m) breaks.
    std::vector<Break> grow(const std::function<double(double)>& limit, double growth) {
        const Bonds& bonds = model_.bonds;
        state_ = initial_state(model_);
        const double l0 = case_.spacing();
        const int local = static_cast<int>(at_rest_.size());
        change_ = Eigen::MatrixXd::Zero(local, local);
        std::vector<Break> breaks;
        Eigen::VectorXd u = at_rest_;
        std::vector<int> watched;
        std::vector<double> limits;
        for (int b = 0; b < bonds.count(); ++b) {
            if (!inner(bonds.first[b]) || !inner(bonds.second[b])) continue;
            watched.push_back(b);
            limits.push_back(limit(bonds.rest_length[b]));
        }
        for (;;) {
            int weakest = -1;
            double most = 0;
            for (std::size_t k = 0; k < watched.size(); ++k) {
                const int b = watched[k];
                if (!state_.is_intact(b)) continue;
                const double over = strain(u, b) / limits[k];
                if (over > most) most = over, weakest = b;
            }
            if (weakest < 0) return breaks;
            const auto& X = model_.particles.reference_position;
            const Vec<2> middle =
                ((X[bonds.first[weakest]] + X[bonds.second[weakest]]) / 2 - case_.tip()) / l0;
            breaks.push_back({weakest, case_.intensity() / most, middle});
            if (middle.x() >= growth) return breaks;
            const int ends[] = {bonds.first[weakest], bonds.second[weakest]};
            for (const int p : ends) add(p, -1);
            state_.broken_at[weakest] = 0;
            for (const int p : ends) add(p, 1);
            u = changed(change_);
        }
    }

    /// Displacements of the particles near the tip at unit stress with the bonds broken as they are now (m):
    /// the quick way, and by solving the whole strip again.
    Eigen::VectorXd quick() const { return changed(change_); }
    Eigen::VectorXd slow() const { return restricted(factors()->solve(load_)); }

 private:
    StripCase case_;
    Model<2> model_;
    State<2> state_;
    BondWeights weights_;
    std::vector<int> near_, list_;  ///< index near the tip of every particle, or -1; and back
    Eigen::VectorXd load_, at_rest_;
    Eigen::MatrixXd compliance_, change_;

    using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
    std::unique_ptr<Factors> factors() const {
        Eigen::SparseMatrix<double> K = tangent(model_, state_);
        for (const int dof : pinned()) K.coeffRef(dof, dof) *= 1e9;
        auto solver = std::make_unique<Factors>(K);
        if (solver->info() != Eigen::Success) throw std::runtime_error("the strip cannot be solved");
        return solver;
    }

    Vec<2> bond_vector(int b) const {
        const auto& X = model_.particles.reference_position;
        return X[model_.bonds.second[b]] - X[model_.bonds.first[b]];
    }
    /// All its neighbours are near the tip too.
    bool inner(int p) const {
        if (near_[p] < 0) return false;
        const Bonds& bonds = model_.bonds;
        for (int k = bonds.start[p]; k < bonds.start[p + 1]; ++k)
            if (near_[bonds.other(bonds.bonds_of[k], p)] < 0) return false;
        return true;
    }
    double strain(const Eigen::VectorXd& u, int b) const {
        const Vec<2> r0 = bond_vector(b);
        const Vec<2> du =
            u.segment<2>(2 * near_[model_.bonds.second[b]]) - u.segment<2>(2 * near_[model_.bonds.first[b]]);
        return du.dot(r0) / r0.squaredNorm();
    }
    /// u = u0 - F change u, with F the compliance: solved for the few rows in which `change` is not zero.
    Eigen::VectorXd changed(const Eigen::MatrixXd& change) const {
        std::vector<int> rows;
        for (int k = 0; k < change.rows(); ++k)
            if (change(k, k) != 0) rows.push_back(k);
        const Eigen::MatrixXd few = change(rows, rows), F = compliance_(rows, rows);
        const Eigen::VectorXd u0 = at_rest_(rows);
        const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(few.rows(), few.rows()) + F * few;
        const Eigen::VectorXd pull = few * system.partialPivLu().solve(u0);
        return at_rest_ - compliance_(Eigen::all, rows) * pull;
    }
    Eigen::VectorXd restricted(const Eigen::VectorXd& all) const {
        Eigen::VectorXd part(2 * list_.size());
        for (std::size_t k = 0; k < list_.size(); ++k) part.segment<2>(2 * k) = all.segment<2>(2 * list_[k]);
        return part;
    }
    void add(int p, double sign) {
        std::vector<int> members;
        const Eigen::MatrixXd K = stiffness_of_particle(model_, state_, weights_, p, members);
        for (std::size_t a = 0; a < members.size(); ++a)
            for (std::size_t b = 0; b < members.size(); ++b)
                change_.block<2, 2>(2 * near_[members[a]], 2 * near_[members[b]]) +=
                    sign * K.block<2, 2>(2 * a, 2 * b);
    }
    /// Three degrees of freedom at the right edge, far from the crack, that hold the strip without straining
    /// it.
    std::vector<int> pinned() const {
        const auto nearest = [&](const Vec<2>& place) {
            int best = 0;
            const auto& X = model_.particles.reference_position;
            for (int i = 0; i < model_.particles.count(); ++i)
                if ((X[i] - place).squaredNorm() < (X[best] - place).squaredNorm()) best = i;
            return best;
        };
        const int low = nearest({1, 0.15 * case_.height}), high = nearest({1, 0.85 * case_.height});
        return {2 * low, 2 * low + 1, 2 * high};
    }
};

}  // namespace hibi::test
