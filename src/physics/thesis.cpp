#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "physics/bond_list.hpp"
#include "physics/elastic.hpp"

namespace hibi {

namespace {

/// The variant of Ando's thesis: plain weights over the bulk number density, each particle with an angle of
/// its own, bonds turning by the mean angle of their ends. The reference that reports compare against.
///     U = sum_i { mu sum_j s |r - R_ij r0|^2 / |r0|^2 + lambda V D_i^2 / 2 },  R_ij by (theta_i + theta_j) /
///     2 D_i = (1/V) sum_j s r . R_ij r0 / |r0|^2 - m_i,  m_i = (1/V) sum_j s over alive bonds
/// Forces and torques are the exact derivatives. Plane only.
class ThesisLaw final : public ElasticLaw<2> {
 public:
    ThesisLaw(const Model<2>& model, const BreakLimits& limits) : list_(model, thesis_weights(model)) {
        assert(model.spin);
        if (!limits.upper.empty()) list_.watch(limits);
        for (const Material& m : model.materials) {
            two_mu_.push_back(2 * shear_modulus(m));
            lambda_.push_back(lame_lambda(m, model.assumption));
        }
        dilatation_.resize(model.particles.count());
    }

    void displaced(const Model<2>&, int, int) override {}

    std::vector<int> sum_forces(Model<2>& model, const std::function<void(int, int)>& then) override {
        Particles<2>& particles = model.particles;
        std::vector<char> beyond(block_count(particles.count()), false);
        parallel_for(particles.count(), [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                dilatation_[i] = dilatation(particles, *model.spin, i);
                if (!list_.upper.empty() && list_.is_beyond_limits(particles.displacement, i))
                    beyond[begin / parallel_block] = true;
            }
        });
        const std::vector<Vec<2>>& u = particles.displacement;
        Spin& spin = *model.spin;
        parallel_for(particles.count(), [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                const double two_mu = two_mu_[particles.material[i]];
                const double pressure = lambda_[particles.material[i]] * dilatation_[i];
                Vec<2> sum = Vec<2>::Zero();
                double moment = 0;
                for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                    const int j = list_.neighbour[k], material = particles.material[j];
                    const Vec<2> r0 = list_.r0[k], du = u[j] - u[i];
                    const Rotated t = rotated(spin, i, j, r0);
                    const double spring = list_.own[k] * two_mu + list_.other[k] * two_mu_[material];
                    const double push =
                        list_.own[k] * pressure + list_.other[k] * lambda_[material] * dilatation_[j];
                    const Vec<2> Rr0 = r0 + t.change;
                    sum += spring * (du - t.change) + push * Rr0;
                    // -dU/dphi = (spring - push) r . J R r0, and each end takes half of the bond's angle
                    const Vec<2> r = r0 + du;
                    moment += (spring - push) * (r.y() * Rr0.x() - r.x() * Rr0.y()) / 2;
                }
                particles.force[i] = sum;
                spin.torque[i] = moment;
            }
            if (then) then(begin, end);
        });
        return true_places(beyond);
    }

    void renew(Model<2>& model, const std::vector<int>&, const std::function<void(int, int)>& then) override {
        sum_forces(model, then);
    }

    double energy(const Model<2>& model) const override {
        return parallel_sum<double>(model.particles.count(), [&](int begin, int end) {
            double sum = 0;
            for (int i = begin; i < end; ++i) sum += local(model, i).energy;
            return sum;
        });
    }

    LocalState<2> local(const Model<2>& model, int i) const override {
        const Particles<2>& particles = model.particles;
        const std::vector<Vec<2>>& u = particles.displacement;
        const int material = particles.material[i];
        const double mu = two_mu_[material] / 2, lambda = lambda_[material];
        const double volume = particles.volume[i], D = dilatation(particles, *model.spin, i);
        LocalState<2> state;
        Mat<2> strain = Mat<2>::Zero();
        LargestStrain largest;
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
            const Rotated t = rotated(*model.spin, i, list_.neighbour[k], list_.r0[k]);
            const Vec<2>& r0 = list_.r0[k];
            const Vec<2> du = u[list_.neighbour[k]] - u[i], stretch = du - t.change;
            largest.look((2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm());
            state.energy += mu * list_.own[k] * stretch.squaredNorm();
            strain += list_.own[k] / volume * stretch * (list_.r0[k] + t.change).transpose();
        }
        strain = (strain + strain.transpose()).eval() / 2;
        state.dilatation = D;
        state.bond_strain = largest.strain();
        state.energy += lambda * volume * D * D / 2;
        state.stress = 2 * mu * strain + lambda * D * Mat<2>::Identity();
        return state;
    }

    std::vector<LocalState<2>> local(const Model<2>& model, int begin, int end) const override {
        std::vector<LocalState<2>> states;
        for (int i = begin; i < end; ++i) states.push_back(local(model, i));
        return states;
    }

    void remove(const Bonds& bonds, int bond) override { list_.remove(bonds, bond); }

 private:
    struct Rotated {
        Vec<2> change;  ///< (R_ij - I) r0
    };
    static Rotated rotated(const Spin& spin, int i, int j, const Vec<2>& r0) {
        const double phi = (spin.angle[i] + spin.angle[j]) / 2;
        const double s = std::sin(phi), half = std::sin(phi / 2), c1 = -2 * half * half;
        return {{c1 * r0.x() - s * r0.y(), s * r0.x() + c1 * r0.y()}};
    }

    /// sum_j s (r . R r0 - |r0|^2) / |r0|^2 / V, each term without cancellation:
    /// r . R r0 - |r0|^2 = du . R r0 + r0 . (R - I) r0
    double dilatation(const Particles<2>& particles, const Spin& spin, int i) const {
        const std::vector<Vec<2>>& u = particles.displacement;
        double sum = 0;
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
            const int j = list_.neighbour[k];
            const Vec<2> r0 = list_.r0[k], change = rotated(spin, i, j, r0).change;
            sum += list_.own[k] * ((u[j] - u[i]).dot(r0 + change) + r0.dot(change));
        }
        return sum / particles.volume[i];
    }

    BondList<2> list_;
    std::vector<double> two_mu_, lambda_;  ///< per material (Pa)
    std::vector<double> dilatation_;
};

}  // namespace

std::unique_ptr<ElasticLaw<2>> make_thesis_law(const Model<2>& model, const BreakLimits& limits) {
    return std::make_unique<ThesisLaw>(model, limits);
}

template <int Dim>
Spin make_spin(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const std::vector<double> zero(particles.count(), 0.0);
    Spin spin{zero, zero, zero, zero};
    for (int i = 0; i < particles.count(); ++i)
        spin.inertia[i] = particles.mass[i] * particles.spacing[i] * particles.spacing[i] / 6;
    return spin;
}
template Spin make_spin<2>(const Model<2>&);

}  // namespace hibi
