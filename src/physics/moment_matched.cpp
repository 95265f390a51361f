#include <cmath>

#include "base/parallel.hpp"
#include "physics/bond_list.hpp"
#include "physics/dilatation.hpp"
#include "physics/elastic.hpp"

namespace hibi {

namespace {

/// Rotation R of a particle, kept as R - I so that a small rotation keeps its digits.
template <int Dim>
struct Turn;
template <>
struct Turn<2> {
    double cosine_less_one = 0, sine = 0;
    /// (R - I) v
    Vec<2> change(const Vec<2>& v) const {
        return {cosine_less_one * v.x() - sine * v.y(), sine * v.x() + cosine_less_one * v.y()};
    }
    Mat<2> matrix() const {
        Mat<2> R;
        R << 1 + cosine_less_one, -sine, sine, 1 + cosine_less_one;
        return R;
    }
};

/// A_i - M_i with M_i its value at rest, reduced to what the energy needs: the trace and the antisymmetric
/// part.
template <int Dim>
struct Deformation;
template <>
struct Deformation<2> {
    double trace = 0, twist = 0;  ///< tr(A - M), A21 - A12
    void add(double share, const Vec<2>& r0, const Vec<2>& du) {
        trace += share * (du.x() * r0.x() + du.y() * r0.y());
        twist += share * (du.y() * r0.x() - du.x() * r0.y());
    }
};

/// Polar rotation of A and dilatation D = tr(R^T A) - m, from A - M and m = tr M, without cancellation at
/// small strain.
struct Polar2 {
    Turn<2> turn;
    double dilatation = 0;
};
Polar2 polar(const Deformation<2>& h, double m) {
    const double along = m + h.trace;
    const double q = std::sqrt(along * along + h.twist * h.twist);
    if (q == 0) return {};  // no bonds left, or exactly turned inside out: any rotation is stationary
    // q - m = (q^2 - m^2) / (q + m), and along - q likewise unless along < 0
    const double D = (h.trace * (2 * m + h.trace) + h.twist * h.twist) / (q + m);
    const double c1 = along >= 0 ? -h.twist * h.twist / (q * (q + along)) : (along - q) / q;
    return {{c1, h.twist / q}, D};
}

/// What particle i adds to the force of its bonds beyond the springs: P r0 with P = -2 mu (R - I) + lambda D
/// R.
template <int Dim>
struct Pull;
template <>
struct Pull<2> {
    double diagonal = 0, twist = 0;
    Pull() = default;
    Pull(const Polar2& p, double two_mu, double lambda)
        : diagonal(-two_mu * p.turn.cosine_less_one + lambda * p.dilatation * (1 + p.turn.cosine_less_one)),
          twist(-two_mu * p.turn.sine + lambda * p.dilatation * p.turn.sine) {}
};

/// Equations: U = sum_i { mu sum_j s_ij |r - R_i r0|^2 / |r0|^2 + lambda V D_i^2 / 2 }; R_i makes U
/// stationary, so it adds no term to the force.
template <int Dim>
class MomentMatched final : public ElasticLaw<Dim> {
 public:
    explicit MomentMatched(const Model<Dim>& model)
        : list_(model, moment_matched_weights(model)), lambda_(dilatation_moduli(model)) {
        for (const Material& m : model.materials) two_mu_.push_back(2 * shear_modulus(m));
        const int n = model.particles.count();
        volume_ = model.particles.volume;
        trace_at_rest_.resize(n);
        pull_.resize(n);
        for (int i = 0; i < n; ++i) update_trace(i);
    }

    bool forces(Model<Dim>& model) override {
        const Particles<Dim>& particles = model.particles;
        parallel_for(particles.count(), [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                pull_[i] = Pull<Dim>(polar_of(particles, i), two_mu_[particles.material[i]], lambda_[i]);
        });
        return list_.upper.empty() ? sum_forces<false>(model.particles) : sum_forces<true>(model.particles);
    }

    LocalState<Dim> local(const Model<Dim>& model, int i) const override {
        const Particles<Dim>& particles = model.particles;
        const std::vector<Vec<Dim>>& u = particles.displacement;
        const double mu = two_mu_[particles.material[i]] / 2, lambda = lambda_[i];
        const double volume = particles.volume[i];
        const Polar2 p = polar_of(particles, i);
        const Mat<Dim> R = p.turn.matrix();
        LocalState<Dim> state;
        Mat<Dim> strain = Mat<Dim>::Zero();  // sym(R^T A) - M, in the particle's own frame
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
            const Vec<Dim> du = u[list_.neighbour[k]] - u[i];
            const Vec<Dim> stretch = du - p.turn.change(list_.r0[k]);  // r - R r0
            state.energy += mu * list_.own[k] * stretch.squaredNorm();
            strain += list_.own[k] / volume * (R.transpose() * stretch) * list_.r0[k].transpose();
        }
        strain = (strain + strain.transpose()).eval() / 2;
        state.dilatation = p.dilatation;
        state.energy += lambda * volume * p.dilatation * p.dilatation / 2;
        state.stress = R * (2 * mu * strain + lambda * p.dilatation * Mat<Dim>::Identity()) * R.transpose();
        return state;
    }

    void remove(const Bonds& bonds, int bond) override {
        list_.remove(bonds, bond);
        update_trace(bonds.first[bond]);
        update_trace(bonds.second[bond]);
    }

    void watch(const BreakLimits& limits) override { list_.watch(limits); }

 private:
    /// m_i sums alive bonds only: with d in its place a resting fragment would carry a false pressure.
    void update_trace(int i) {
        double sum = 0;
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k)
            sum += list_.own[k] * list_.r0[k].squaredNorm();
        trace_at_rest_[i] = sum / volume_[i];
    }

    Polar2 polar_of(const Particles<Dim>& particles, int i) const {
        const std::vector<Vec<Dim>>& u = particles.displacement;
        Deformation<Dim> h;
        const double per_volume = 1 / particles.volume[i];
        const Vec<Dim> ui = u[i];
        for (int k = list_.start[i]; k < list_.start[i + 1]; ++k)
            h.add(list_.own[k] * per_volume, list_.r0[k], u[list_.neighbour[k]] - ui);
        return polar(h, trace_at_rest_[i]);
    }

    template <bool Watch>
    bool sum_forces(Particles<Dim>& particles) {
        const std::vector<Vec<Dim>>& u = particles.displacement;
        std::vector<char> passed((particles.count() + parallel_block - 1) / parallel_block, 0);
        parallel_for(particles.count(), [&](int begin, int end) {
            bool beyond = false;
            for (int i = begin; i < end; ++i) {
                const double two_mu = two_mu_[particles.material[i]];
                const Pull<Dim> mine = pull_[i];
                const Vec<Dim> ui = u[i];
                Vec<Dim> sum = Vec<Dim>::Zero();
                for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                    const int j = list_.neighbour[k];
                    const double own = list_.own[k], other = list_.other[k];
                    const Vec<Dim> r0 = list_.r0[k], du = u[j] - ui;
                    const double spring = own * two_mu + other * two_mu_[particles.material[j]];
                    const double diagonal = own * mine.diagonal + other * pull_[j].diagonal;
                    const double twist = own * mine.twist + other * pull_[j].twist;
                    sum.x() += spring * du.x() + (diagonal * r0.x() - twist * r0.y());
                    sum.y() += spring * du.y() + (diagonal * r0.y() + twist * r0.x());
                    if constexpr (Watch) {
                        const double growth = 2 * r0.dot(du) + du.squaredNorm();  // L^2 - L0^2
                        beyond |= growth > list_.upper[k] || growth < list_.lower[k];
                    }
                }
                particles.force[i] = sum;
            }
            if (beyond) passed[begin / parallel_block] = 1;
        });
        for (const char p : passed)
            if (p) return true;
        return false;
    }

    BondList<Dim> list_;
    std::vector<double> lambda_;         ///< per particle (Pa)
    std::vector<double> two_mu_;         ///< per material (Pa)
    std::vector<double> volume_;         ///< V (m^3)
    std::vector<double> trace_at_rest_;  ///< m_i [-]
    std::vector<Pull<Dim>> pull_;
};

}  // namespace

std::unique_ptr<ElasticLaw<2>> make_thesis_law(const Model<2>& model);

template <>
std::unique_ptr<ElasticLaw<2>> make_elastic_law<2>(const Model<2>& model, Elasticity elasticity) {
    if (elasticity == Elasticity::thesis) return make_thesis_law(model);
    return std::make_unique<MomentMatched<2>>(model);
}

template <int Dim>
double ElasticLaw<Dim>::energy(const Model<Dim>& model) const {
    return parallel_sum<double>(model.particles.count(), [&](int begin, int end) {
        double sum = 0;
        for (int i = begin; i < end; ++i) sum += local(model, i).energy;
        return sum;
    });
}
template double ElasticLaw<2>::energy(const Model<2>&) const;

}  // namespace hibi
