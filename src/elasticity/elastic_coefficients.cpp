#include "elasticity/elastic_coefficients.hpp"

#include <algorithm>
#include <cmath>

#include "elasticity/dilatation.hpp"
#include "elasticity/mixed_bonds.hpp"
#include "elasticity/moment_factors.hpp"

namespace hibi {

namespace {

/// How far the shares of a mixed bond go from those of length to those of compliance.
constexpr double towards_compliance = 0.4;
/// lambda / 2 mu at which only half as far. (nu = 0.45 in plane strain)
constexpr double nearly_incompressible = 4.5;
/// Of the steepest rise of log mu that there can be: below, an interface has no direction.
constexpr double no_direction = 1e-3;
/// Error of a matched moment below which it counts as matched.
constexpr double matched = 1e-6;

/// The mixed bonds of a model, and what becomes of the particles at their ends.
template <int Dim>
class Interfaces {
 public:
    Interfaces(const Model<Dim>& model, const BondWeights& plain, std::vector<MixedBond> mixed)
        : model_(model),
          plain_(plain),
          mixed_(std::move(mixed)),
          place_(model.bonds.count(), -1),
          rise_(model.particles.count(), Vec<Dim>::Zero()) {
        const Bonds& bonds = model.bonds;
        for (std::size_t k = 0; k < mixed_.size(); ++k) {
            const int b = mixed_[k].bond, i = bonds.first[b], j = bonds.second[b];
            place_[b] = static_cast<int>(k);
            const Vec<Dim>& r0 = model.bond_vectors[b];
            const Vec<Dim> rise = std::log(mu(j) / mu(i)) / r0.squaredNorm() * r0;
            rise_[i] += plain.forward[b] / model.particles.volume[i] * rise;
            rise_[j] += plain.backward[b] / model.particles.volume[j] * rise;
        }
    }

    double lambda_over_two_mu(int i) const {
        return lame_lambda(material(i), model_.assumption) / (2 * mu(i));
    }

    bool touches(int i) const {
        const Bonds& bonds = model_.bonds;
        return std::any_of(bonds.bonds_of.begin() + bonds.start[i],
                           bonds.bonds_of.begin() + bonds.start[i + 1],
                           [&](int b) { return place_[b] >= 0; });
    }

    /// s_ij of all bonds of a particle, in their order, and by how much the dilatation that they make
    /// overstates a stretch across the interface.
    struct Weights {
        std::vector<double> s;
        double overstated = 1;
    };
    /// In series. `towards`: how far the shares go from those of length to those of compliance.
    Weights in_series(int i, double towards) const {
        std::vector<Vec<Dim>> normals;
        std::vector<double> share;
        std::vector<int> own;
        Weights weights;
        Symmetric<Dim> target = Symmetric<Dim>::Zero();
        each_bond(i, [&](int b, const Vec<Dim>& n, double plain) {
            target += plain * dyad<Dim>(n);
            if (place_[b] < 0) {
                own.push_back(static_cast<int>(weights.s.size()));
                normals.push_back(n);
                share.push_back(plain);
                weights.s.push_back(plain);
                return;
            }
            const MixedBond& mixed = mixed_[place_[b]];
            const End end = this->end(mixed, i, towards);
            weights.s.push_back(end.weight * plain);
            // Of a stretch along c this side has 1 / weight times as much as the bond (if its share is that
            // of length), of one along t as much as the bond: their parts are (2 length c + weight t) (x) n.
            const Vec<Dim> across = normal(mixed, n), c = across.dot(n) * across, t = n - c;
            const double of_c = 2 * end.length, of_t = end.weight;
            target -= plain *
                      ((of_c + of_t) / 2 * dyad<Dim>(n) + (of_c - of_t) / 2 * (dyad<Dim>(c) - dyad<Dim>(t)));
            weights.overstated += 2 * (end.share - end.length) * plain * c.squaredNorm();
        });
        const std::vector<double> factor = moment_factors<Dim>(normals, share, target);
        for (std::size_t k = 0; k < own.size(); ++k) weights.s[own[k]] *= factor[k];
        for (double& s : weights.s) s *= model_.particles.volume[i];
        weights.overstated = std::max(1.0, weights.overstated);
        return weights;
    }

    /// By the bonds that are not mixed, as at a free surface; where these do not span the space, as in a
    /// layer of one particle, by all, shared out by length.
    Gauge gauge(int i, double lambda) const {
        std::vector<Vec<Dim>> normals;
        std::vector<double> share;
        std::vector<int> own;
        each_bond(i, [&](int b, const Vec<Dim>& n, double plain) {
            if (place_[b] >= 0) return;
            own.push_back(b);
            normals.push_back(n);
            share.push_back(plain);
        });
        Symmetric<Dim> lacking = identity<Dim>();
        const std::vector<double> factor = moment_factors<Dim>(normals, share, identity<Dim>());
        for (std::size_t k = 0; k < own.size(); ++k) lacking -= share[k] * factor[k] * dyad<Dim>(normals[k]);
        Gauge gauge{i, lambda, {}};
        if (lacking.norm() < matched) {
            for (std::size_t k = 0; k < own.size(); ++k)
                gauge.bonds.emplace_back(own[k], model_.particles.volume[i] * share[k] * factor[k]);
            return gauge;
        }
        const Weights all = in_series(i, 0);
        for (std::size_t k = 0; k < all.s.size(); ++k)
            gauge.bonds.emplace_back(model_.bonds.bonds_of[model_.bonds.start[i] + static_cast<int>(k)],
                                     all.s[k]);
        return gauge;
    }

 private:
    struct End {
        double length = 0;  ///< f: part of the bond on this end's side
        double share = 0;   ///< p: of the bond's spring
        double weight = 0;  ///< 2 p mu_b / mu_i
    };

    /// Calls visit(bond, direction, s_ij / V) for all bonds of i, with s_ij as if there were one material.
    template <class Visit>
    void each_bond(int i, Visit&& visit) const {
        const Bonds& bonds = model_.bonds;
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int b = bonds.bonds_of[k];
            const double s = bonds.first[b] == i ? plain_.forward[b] : plain_.backward[b];
            visit(b, model_.bond_vectors[b].normalized(), s / model_.particles.volume[i]);
        }
    }

    End end(const MixedBond& mixed, int i, double towards) const {
        const int b = mixed.bond, j = model_.bonds.other(b, i);
        const double f = model_.bonds.first[b] == i ? mixed.first_length : 1 - mixed.first_length;
        const double q = f / mu(i) / (f / mu(i) + (1 - f) / mu(j));
        const double ratio = std::max(lambda_over_two_mu(i), lambda_over_two_mu(j)) / nearly_incompressible;
        towards /= 1 + ratio * ratio;
        const double p = (1 - towards) * f + towards * q;
        return {f, p, 2 * p * mixed.modulus / mu(i)};
    }

    /// Of the interface that a bond crosses; the bond's own direction n where there is no other.
    Vec<Dim> normal(const MixedBond& mixed, const Vec<Dim>& n) const {
        const int i = model_.bonds.first[mixed.bond], j = model_.bonds.second[mixed.bond];
        // Both ends of a bond through a thin layer see the modulus rise away from it.
        const Vec<Dim> sum = rise_[i] + rise_[j], difference = rise_[i] - rise_[j];
        const Vec<Dim>& rise = sum.squaredNorm() >= difference.squaredNorm() ? sum : difference;
        const double steepest =
            std::max(std::abs(std::log(mu(i) / mixed.modulus)), std::abs(std::log(mu(j) / mixed.modulus))) /
            model_.particles.spacing[i];
        return rise.norm() > no_direction * steepest ? rise.normalized() : n;
    }

    const Material& material(int i) const { return model_.materials[model_.particles.material[i]]; }
    double mu(int i) const { return shear_modulus(material(i)); }

    const Model<Dim>& model_;
    const BondWeights& plain_;
    std::vector<MixedBond> mixed_;
    std::vector<int> place_;      ///< of a bond in mixed_, or -1
    std::vector<Vec<Dim>> rise_;  ///< of log mu around each particle (1/m)
};

}  // namespace

template <int Dim>
ElasticCoefficients elastic_coefficients(const Model<Dim>& model) {
    ElasticCoefficients coefficients{moment_matched_weights(model), dilatation_moduli(model)};
    std::vector<MixedBond> mixed = mixed_bonds(model);
    if (mixed.empty()) return coefficients;
    const Bonds& bonds = model.bonds;
    const BondWeights plain = coefficients.s;
    const Interfaces<Dim> interfaces(model, plain, std::move(mixed));
    for (int i = 0; i < model.particles.count(); ++i) {
        if (!interfaces.touches(i)) continue;
        // Beyond, the pressure hangs on a dilatation so small that only the energy's own keeps it in bounds.
        if (interfaces.lambda_over_two_mu(i) < nearly_incompressible)
            coefficients.gauges.push_back(interfaces.gauge(i, coefficients.lambda[i]));
        const auto weights = interfaces.in_series(i, towards_compliance);
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int b = bonds.bonds_of[k];
            (bonds.first[b] == i ? coefficients.s.forward : coefficients.s.backward)[b] =
                weights.s[k - bonds.start[i]];
        }
        coefficients.lambda[i] /= weights.overstated * weights.overstated;
    }
    return coefficients;
}

template ElasticCoefficients elastic_coefficients<2>(const Model<2>&);

}  // namespace hibi
