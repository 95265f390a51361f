#pragma once
#include "elasticity/elastic_coefficients.hpp"
#include "elasticity/elastic_law.hpp"

namespace hibi::test {

/// The judge of the fast loops: forces of the moment-matched law by one plain loop over the bonds of each
/// particle, straight from the model and in the order that the fast loops promise to keep.
///     f_i = sum_j [ spring du + (s_ij P_i + s_ji P_j) r0 / |r0|^2 ],  P = -2 mu (R - I) + lambda D R
inline std::vector<Vec<2>> plain_forces(const Model<2>& model, const State<2>& state,
                                         const ElasticCoefficients& coefficients) {
    const Particles<2>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const BondWeights& s = coefficients.s;
    const std::vector<double>& lambda = coefficients.lambda;
    const auto two_mu = [&](int i) { return 2 * shear_modulus(model.materials[particles.material[i]]); };
    struct Seen {
        int j;
        Vec<2> r0, du;
        double own, other;
    };
    const auto each_bond = [&](int i, auto&& visit) {
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int b = bonds.bonds_of[k], j = bonds.other(b, i);
            if (!state.is_intact(b)) continue;
            const bool forward = bonds.first[b] == i;
            const Vec<2> r0 = (forward ? 1 : -1) * model.bond_vectors[b];
            const double square = r0.squaredNorm();
            visit(Seen{j, r0, state.displacement[j] - state.displacement[i],
                       (forward ? s.forward[b] : s.backward[b]) / square,
                       (forward ? s.backward[b] : s.forward[b]) / square});
        }
    };
    std::vector<double> diagonal(particles.count(), 0), twisted(particles.count(), 0);
    for (int i = 0; i < particles.count(); ++i) {
        double trace = 0, twist = 0, m = 0;
        each_bond(i, [&](const Seen& bond) {
            const Vec<2> a = bond.own / particles.volume[i] * bond.r0;
            trace += bond.du.x() * a.x() + bond.du.y() * a.y();
            twist += bond.du.y() * a.x() - bond.du.x() * a.y();
            m += bond.own * bond.r0.squaredNorm();
        });
        m /= particles.volume[i];
        const double along = m + trace, q = std::sqrt(along * along + twist * twist);
        if (q == 0) continue;
        const double sum = along < 0 ? 1 : q + along, high = q + m, reciprocal = 1 / (q * sum * high);
        const double sine = twist * (reciprocal * (sum * high));
        const double cosine_less_one =
            along < 0 ? (along - q) * (reciprocal * (sum * high)) : -twist * sine * (reciprocal * (q * high));
        const double D = (trace * (2 * m + trace) + twist * twist) * (reciprocal * (q * sum));
        diagonal[i] = lambda[i] * D * (1 + cosine_less_one) - two_mu(i) * cosine_less_one;
        twisted[i] = lambda[i] * D * sine - two_mu(i) * sine;
    }
    std::vector<Vec<2>> force(particles.count());
    for (int i = 0; i < particles.count(); ++i) {
        force[i].setZero();
        each_bond(i, [&](const Seen& bond) {
            const double spring = bond.own * two_mu(i) + bond.other * two_mu(bond.j);
            const Vec<2> mean = (bond.own + bond.other) / 2 * bond.r0;
            const Vec<2> half_difference = (bond.own - bond.other) / 2 * bond.r0;
            const auto pull = [](double p, double q, const Vec<2>& v) {
                return Vec<2>(p * v.x() - q * v.y(), p * v.y() + q * v.x());
            };
            const double d = diagonal[i] + diagonal[bond.j], t = twisted[i] + twisted[bond.j];
            const double dd = diagonal[i] - diagonal[bond.j], dt = twisted[i] - twisted[bond.j];
            force[i] += spring * bond.du + (pull(d, t, mean) + pull(dd, dt, half_difference));
        });
    }
    return force;
}

}  // namespace hibi::test
