#pragma once
#include "physics/dilatation.hpp"
#include "physics/elastic.hpp"
#include "physics/weights.hpp"

namespace hibi::test {

/// The judge of the fast loops: forces of the moment-matched law by one plain loop over the bonds of each
/// particle, straight from the model and in the order that the fast loops promise to keep.
///     f_i = P_i sum_j s_ij r0 / |r0|^2 + sum_j [ spring du + s_ji / |r0|^2 P_j r0 ],  P = -2 mu (R - I) +
///     lambda D R
inline std::vector<Vec<2>> plain_forces(const Model<2>& model, const BondWeights& s) {
    const Particles<2>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const std::vector<double> lambda = dilatation_moduli(model);
    const auto two_mu = [&](int i) { return 2 * shear_modulus(model.materials[particles.material[i]]); };
    struct Seen {
        int j;
        Vec<2> r0, du;
        double own, other;
    };
    const auto each_bond = [&](int i, auto&& visit) {
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int b = bonds.bonds_of[k], j = bonds.other(b, i);
            if (!bonds.is_intact(b)) continue;
            const bool forward = bonds.first[b] == i;
            const Vec<2> r0 = (forward ? 1 : -1) * model.bond_vectors[b];
            const double square = r0.squaredNorm();
            visit(Seen{j, r0, particles.displacement[j] - particles.displacement[i],
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
        Vec<2> f = Vec<2>::Zero(), g = Vec<2>::Zero();
        each_bond(i, [&](const Seen& bond) {
            const double spring = bond.own * two_mu(i) + bond.other * two_mu(bond.j);
            const Vec<2> e = bond.other * bond.r0;
            f.x() += spring * bond.du.x() + (diagonal[bond.j] * e.x() - twisted[bond.j] * e.y());
            f.y() += spring * bond.du.y() + (diagonal[bond.j] * e.y() + twisted[bond.j] * e.x());
            g += bond.own * bond.r0;
        });
        force[i].x() = f.x() + (diagonal[i] * g.x() - twisted[i] * g.y());
        force[i].y() = f.y() + (diagonal[i] * g.y() + twisted[i] * g.x());
    }
    return force;
}

}  // namespace hibi::test
