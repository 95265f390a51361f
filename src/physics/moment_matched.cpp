#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "physics/block_order.hpp"
#include "physics/bond_kernel.hpp"
#include "physics/compact_bonds.hpp"
#include "physics/elastic.hpp"
#include "physics/elastic_coefficients.hpp"

namespace hibi {

namespace {

/// Polar rotation R of A and dilatation D = tr(R^T A) - m.
struct Polar {
    double cosine_less_one = 0, sine = 0;  ///< of R - I, so that a small rotation keeps its digits
    double dilatation = 0;

    /// (R - I) v
    Vec<2> change(const Vec<2>& v) const {
        return {cosine_less_one * v.x() - sine * v.y(), sine * v.x() + cosine_less_one * v.y()};
    }
    Mat<2> rotation() const {
        Mat<2> R;
        R << 1 + cosine_less_one, -sine, sine, 1 + cosine_less_one;
        return R;
    }
};

/// From the trace and the antisymmetric part A21 - A12 of A - M, with M its value at rest and m = tr M:
/// without cancellation at small strain, and with one division, all in the order of the loops.
Polar polar(double trace, double twist, double m) {
    const double along = m + trace;
    const double q = std::sqrt(along * along + twist * twist);
    if (q == 0) return {};  // no bonds left, or exactly turned inside out: any rotation is stationary
    // q - m = (q^2 - m^2) / (q + m), and along - q likewise unless along < 0
    const double sum = along < 0 ? 1 : q + along, high = q + m;
    const double reciprocal = 1 / (q * sum * high);
    const double sine = twist * (reciprocal * (sum * high));
    const double cosine_less_one =
        along < 0 ? (along - q) * (reciprocal * (sum * high)) : -twist * sine * (reciprocal * (q * high));
    const double D = (trace * (2 * m + trace) + twist * twist) * (reciprocal * (q * sum));
    return {cosine_less_one, sine, D};
}

/// Equations: U = sum_i { mu sum_j s_ij |r - R_i r0|^2 / |r0|^2 + lambda V D_i^2 / 2 }; R_i makes U
/// stationary, so it adds no term to the force.
class MomentMatched final : public ElasticLaw<2> {
 public:
    MomentMatched(const Model<2>& model, const BreakLimits& limits)
        : MomentMatched(model, elastic_coefficients(model), limits) {}

    void displaced(const Model<2>& model, int begin, int end) override {
        bonds_.read(model.particles.displacement, begin, end);
    }

    std::vector<int> sum_forces(Model<2>& model, const std::function<void(int, int)>& then) override {
        const kernel::Arrays arrays = bonds_.arrays(&model.particles.force);
        const auto loop = watches_ ? loops_.deform_and_watch : loops_.deform;
        std::vector<char> beyond(block_count(model.particles.count()));
        order_.walk([&](int b) { beyond[b] = loop(arrays, first_chunk(b), end_chunk(model, b)); },
                    [&](int b) { sum_forces(arrays, model, b, then); });
        return true_places(beyond);
    }

    void renew(Model<2>& model, const std::vector<int>& blocks,
               const std::function<void(int, int)>& then) override {
        const kernel::Arrays arrays = bonds_.arrays(&model.particles.force);
        const int count = static_cast<int>(blocks.size());
        parallel_blocks(count, [&](int k) {
            loops_.deform(arrays, first_chunk(blocks[k]), end_chunk(model, blocks[k]));
        });
        parallel_blocks(count, [&](int k) { sum_forces(arrays, model, blocks[k], then); });
    }

    double energy(const Model<2>& model) const override {
        const int n = model.particles.count();
        parallel_for(n, [&](int begin, int end) { bonds_.read(model.particles.displacement, begin, end); });
        const kernel::Arrays arrays = bonds_.arrays(nullptr);
        return parallel_sum<double>(
            n, [&](int begin, int end) { return loops_.energy(arrays, chunk(begin), chunk(end)); });
    }

    LocalState<2> local(const Model<2>& model, int i) const override {
        LocalState<2> state =
            local(model, i, bonds_.lambda(i), [&](auto&& visit) { bonds_.each_bond(i, visit); });
        if (const auto gauge = first_gauge(i); gauge != gauges_.end() && gauge->particle == i) {
            const LocalState<2> measured =
                local(model, i, gauge->lambda, [&](auto&& visit) { each_bond(model, *gauge, visit); });
            state.stress = measured.stress;
            state.dilatation = measured.dilatation;
        }
        return state;
    }

    std::vector<LocalState<2>> local(const Model<2>& model, int begin, int end) const override {
        std::vector<kernel::State> states((chunk(end) - chunk(begin)) * kernel::lanes);
        loops_.states(bonds_.arrays(nullptr), chunk(begin), chunk(end), states.data());
        std::vector<LocalState<2>> local(end - begin);
        for (int k = 0; k < end - begin; ++k) {
            const kernel::State& s = states[k];
            local[k].energy = s.energy;
            local[k].dilatation = s.dilatation;
            local[k].stress << s.xx, s.xy, s.xy, s.yy;
            local[k].bond_strain = LargestStrain{s.longest, s.shortest}.strain();
        }
        for (auto gauge = first_gauge(begin); gauge != gauges_.end() && gauge->particle < end; ++gauge)
            local[gauge->particle - begin] = this->local(model, gauge->particle);
        return local;
    }

    void remove(const Bonds& bonds, int bond) override {
        bonds_.remove(bonds.first[bond], bonds.second[bond]);
    }

 private:
    MomentMatched(const Model<2>& model, ElasticCoefficients coefficients, const BreakLimits& limits)
        : bonds_(model, coefficients, limits),
          gauges_(std::move(coefficients.gauges)),
          order_(model.bonds),
          loops_(kernel::loops()),
          watches_(!limits.upper.empty()) {}

    /// each_bond(visit) calls visit(j, r0, s_ij / |r0|^2) for some bonds of particle i.
    template <class EachBond>
    LocalState<2> local(const Model<2>& model, int i, double lambda, EachBond&& each_bond) const {
        const std::vector<Vec<2>>& u = model.particles.displacement;
        const double mu = bonds_.two_mu(i) / 2, volume = bonds_.volume(i);
        double trace = 0, twist = 0, m = 0;
        each_bond([&](int j, const Vec<2>& r0, double own) {
            const Vec<2> du = u[j] - u[i], part = own * (1 / volume) * r0;
            trace += du.x() * part.x() + du.y() * part.y();
            twist += du.y() * part.x() - du.x() * part.y();
            m += own * r0.squaredNorm();
        });
        const Polar p = polar(trace, twist, m / volume);
        const Mat<2> R = p.rotation();
        LocalState<2> state;
        Mat<2> strain = Mat<2>::Zero();  // sym(R^T A) - M, in the particle's own frame
        LargestStrain largest;
        each_bond([&](int j, const Vec<2>& r0, double own) {
            const Vec<2> du = u[j] - u[i], stretch = du - p.change(r0);  // the second r - R r0
            largest.look((2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm());
            state.energy += mu * own * stretch.squaredNorm();
            strain += own / volume * (R.transpose() * stretch) * r0.transpose();
        });
        strain = (strain + strain.transpose()).eval() / 2;
        state.dilatation = p.dilatation;
        state.bond_strain = largest.strain();
        state.energy += lambda * volume * p.dilatation * p.dilatation / 2;
        state.stress = R * (2 * mu * strain + lambda * p.dilatation * Mat<2>::Identity()) * R.transpose();
        return state;
    }

    /// The first of particle i or a later one.
    std::vector<Gauge>::const_iterator first_gauge(int i) const {
        return std::lower_bound(gauges_.begin(), gauges_.end(), i,
                                [](const Gauge& gauge, int particle) { return gauge.particle < particle; });
    }
    template <class Visit>
    static void each_bond(const Model<2>& model, const Gauge& gauge, Visit&& visit) {
        for (const auto& [b, s] : gauge.bonds) {
            if (!model.bonds.is_intact(b)) continue;
            const Vec<2> r0 = (model.bonds.first[b] == gauge.particle ? 1 : -1) * model.bond_vectors[b];
            visit(model.bonds.other(b, gauge.particle), r0, s / r0.squaredNorm());
        }
    }

    /// Of a particle at the border of a block: blocks hold whole chunks.
    static int chunk(int particle) { return (particle + kernel::lanes - 1) / kernel::lanes; }
    static int first_chunk(int block) { return chunk(block * parallel_block); }
    static int end_of(const Model<2>& model, int block) {
        return std::min((block + 1) * parallel_block, model.particles.count());
    }
    static int end_chunk(const Model<2>& model, int block) { return chunk(end_of(model, block)); }

    void sum_forces(const kernel::Arrays& arrays, const Model<2>& model, int block,
                    const std::function<void(int, int)>& then) const {
        loops_.sum_forces(arrays, first_chunk(block), end_chunk(model, block));
        if (then) then(block * parallel_block, end_of(model, block));
    }

    mutable CompactBonds bonds_;  ///< keeps a copy of the displacements
    std::vector<Gauge> gauges_;
    BlockOrder order_;
    const kernel::Loops& loops_;
    bool watches_;
};

}  // namespace

std::unique_ptr<ElasticLaw<2>> make_thesis_law(const Model<2>& model, const BreakLimits& limits);

template <>
std::unique_ptr<ElasticLaw<2>> make_elastic_law<2>(const Model<2>& model, Elasticity elasticity,
                                                   const BreakLimits& limits) {
    if (elasticity == Elasticity::thesis) return make_thesis_law(model, limits);
    return std::make_unique<MomentMatched>(model, limits);
}

template <int Dim>
std::vector<int> ElasticLaw<Dim>::forces(Model<Dim>& model) {
    parallel_for(model.particles.count(), [&](int begin, int end) { displaced(model, begin, end); });
    return sum_forces(model);
}
template std::vector<int> ElasticLaw<2>::forces(Model<2>&);

}  // namespace hibi
