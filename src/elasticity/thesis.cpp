#include <cmath>

#include "base/parallel.hpp"
#include "elasticity/bond_list.hpp"
#include "elasticity/tangent.hpp"
#include "elasticity/thesis.hpp"

namespace hibi {

namespace {

/// The variant of Ando's thesis: plain weights over the bulk number density, each particle with an angle of
/// its own, bonds turning by the mean angle of their ends. The reference that reports compare against.
///     U = sum_i { mu sum_j s |r - R_ij r0|^2 / |r0|^2 + lambda V D_i^2 / 2 },  R_ij by (theta_i + theta_j) /
///     2 D_i = (1/V) sum_j s r . R_ij r0 / |r0|^2 - m_i,  m_i = (1/V) sum_j s over alive bonds
/// Forces and torques are the exact derivatives. Plane only.
class ThesisLaw final : public ElasticLaw<2> {
 public:
    ThesisLaw(const Model<2>& model, const BreakLimits& limits)
        : model_(model), list_(model, thesis_weights(model)) {
        if (!limits.upper.empty()) list_.watch(limits);
        for (const Material& m : model.materials) {
            two_mu_.push_back(2 * shear_modulus(m));
            lambda_.push_back(lame_lambda(m, model.assumption));
        }
        dilatation_.resize(model.particles.count());
    }

    /// The particles of a body that spins at the start spin with it: each takes the rotation of its
    /// neighbourhood, sum r0 x dv / sum |r0|^2. What is held in every direction does not turn, as in the thesis.
    void start(State<2>& state, const std::vector<std::array<bool, 3>>& held) const override {
        const int n = model_.particles.count();
        for (std::vector<double>* field : {&state.angle, &state.angular_velocity, &state.torque})
            field->assign(n, 0.0);
        for (int i = 0; i < n; ++i) {
            double turning = 0, square = 0;
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                const int j = list_.neighbour[k];
                const Vec<2> r0 = model_.particles.reference_position[j] - model_.particles.reference_position[i];
                const Vec<2> dv = state.velocity[j] - state.velocity[i];
                turning += r0.x() * dv.y() - r0.y() * dv.x();
                square += r0.squaredNorm();
            }
            if (square > 0 && !(held[i][0] && held[i][1])) state.angular_velocity[i] = turning / square;
        }
    }
    double spin_inertia(int i) const override { return hibi::spin_inertia(model_.particles, i); }

    void update_displacements(const State<2>&, int, int) override {}

    std::vector<int> sum_forces(State<2>& state, const FinishBlock& finish_block) override {
        const Particles<2>& particles = model_.particles;
        std::vector<char> beyond(block_count(particles.count()), false);
        parallel_for(particles.count(), [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                dilatation_[i] = dilatation(state, i);
                if (!list_.upper.empty() && list_.is_beyond_limits(state.displacement, i))
                    beyond[begin / parallel_block] = true;
            }
        });
        const std::vector<Vec<2>>& u = state.displacement;
        parallel_for(particles.count(), [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                const double two_mu = two_mu_[particles.material[i]];
                const double pressure = lambda_[particles.material[i]] * dilatation_[i];
                Vec<2> sum = Vec<2>::Zero();
                double moment = 0;
                for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                    const int j = list_.neighbour[k], material = particles.material[j];
                    const Vec<2> r0 = list_.r0[k], du = u[j] - u[i];
                    const Rotated t = rotated(state, i, j, r0);
                    const double spring = list_.own[k] * two_mu + list_.other[k] * two_mu_[material];
                    const double push =
                        list_.own[k] * pressure + list_.other[k] * lambda_[material] * dilatation_[j];
                    const Vec<2> Rr0 = r0 + t.change;
                    sum += spring * (du - t.change) + push * Rr0;
                    // -dU/dphi = (spring - push) r . J R r0, and each end takes half of the bond's angle
                    const Vec<2> r = r0 + du;
                    moment += (spring - push) * (r.y() * Rr0.x() - r.x() * Rr0.y()) / 2;
                }
                state.force[i] = sum;
                state.torque[i] = moment;
            }
            if (finish_block) finish_block(begin, end);
        });
        return true_places(beyond);
    }

    void recompute_forces(State<2>& state, const std::vector<int>&, const FinishBlock& finish_block) override {
        sum_forces(state, finish_block);
    }

    double energy(const State<2>& state) const override {
        return parallel_sum<double>(model_.particles.count(), [&](int begin, int end) {
            double sum = 0;
            for (int i = begin; i < end; ++i) sum += local(state, i).energy;
            return sum;
        });
    }

    LocalState<2> local(const State<2>& state, int i) const override {
        const Particles<2>& particles = model_.particles;
        const std::vector<Vec<2>>& u = state.displacement;
        const int material = particles.material[i];
        const double mu = two_mu_[material] / 2, lambda = lambda_[material];
        const double volume = particles.volume[i], D = dilatation(state, i);
        LocalState<2> of;
        Mat<2> strain = Mat<2>::Zero();
        LargestStrain largest;
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
            const Rotated t = rotated(state, i, list_.neighbour[k], list_.r0[k]);
            const Vec<2>& r0 = list_.r0[k];
            const Vec<2> du = u[list_.neighbour[k]] - u[i], stretch = du - t.change;
            largest.look((2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm());
            of.energy += mu * list_.own[k] * stretch.squaredNorm();
            strain += list_.own[k] / volume * stretch * (list_.r0[k] + t.change).transpose();
        }
        strain = (strain + strain.transpose()).eval() / 2;
        of.dilatation = D;
        of.bond_strain = largest.strain();
        of.energy += lambda * volume * D * D / 2;
        of.stress = 2 * mu * strain + lambda * D * Mat<2>::Identity();
        return of;
    }

    std::vector<LocalState<2>> local(const State<2>& state, int begin, int end) const override {
        std::vector<LocalState<2>> states;
        for (int i = begin; i < end; ++i) states.push_back(local(state, i));
        return states;
    }

    void remove(int bond) override { list_.remove(model_.bonds, bond); }

    std::unique_ptr<Tangent<2>> tangent(const State<2>&) const override { return nullptr; }
    std::string name() const override { return "bond forces and torques (thesis variant)"; }

 private:
    struct Rotated {
        Vec<2> change;  ///< (R_ij - I) r0
    };
    static Rotated rotated(const State<2>& state, int i, int j, const Vec<2>& r0) {
        const double phi = (state.angle[i] + state.angle[j]) / 2;
        const double s = std::sin(phi), half = std::sin(phi / 2), c1 = -2 * half * half;
        return {{c1 * r0.x() - s * r0.y(), s * r0.x() + c1 * r0.y()}};
    }

    /// sum_j s (r . R r0 - |r0|^2) / |r0|^2 / V, each term without cancellation:
    /// r . R r0 - |r0|^2 = du . R r0 + r0 . (R - I) r0
    double dilatation(const State<2>& state, int i) const {
        const std::vector<Vec<2>>& u = state.displacement;
        double sum = 0;
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
            const int j = list_.neighbour[k];
            const Vec<2> r0 = list_.r0[k], change = rotated(state, i, j, r0).change;
            sum += list_.own[k] * ((u[j] - u[i]).dot(r0 + change) + r0.dot(change));
        }
        return sum / model_.particles.volume[i];
    }

    const Model<2>& model_;
    BondList<2> list_;
    std::vector<double> two_mu_, lambda_;  ///< per material (Pa)
    std::vector<double> dilatation_;
};

}  // namespace

std::unique_ptr<ElasticLaw<2>> make_thesis_law(const Model<2>& model, const BreakLimits& limits) {
    return std::make_unique<ThesisLaw>(model, limits);
}

}  // namespace hibi
