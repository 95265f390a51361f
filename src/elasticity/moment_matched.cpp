#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "elasticity/block_order.hpp"
#include "elasticity/bond_kernel.hpp"
#include "elasticity/compact_bonds.hpp"
#include "elasticity/elastic_coefficients.hpp"
#include "elasticity/elastic_law.hpp"
#include "elasticity/plane_rotation.hpp"
#include "elasticity/tangent.hpp"
#include "elasticity/thesis.hpp"

namespace hibi {

namespace {

/// Equations: U = sum_i { mu sum_j s_ij |r - R_i r0|^2 / |r0|^2 + lambda V D_i^2 / 2 }; R_i makes U
/// stationary, so it adds no term to the force.
class MomentMatched final : public ElasticLaw<2> {
 public:
    MomentMatched(const Model<2>& model, const BreakLimits& limits)
        : MomentMatched(model, elastic_coefficients(model), limits) {}

    void update_displacements(const State<2>& state, int begin, int end) override {
        bonds_.read(state.displacement, begin, end);
    }

    std::vector<int> sum_forces(State<2>& state, const FinishBlock& finish_block) override {
        const kernel::Arrays arrays = bonds_.arrays(&state.force);
        const auto loop = watches_ ? loops_.deform_and_watch : loops_.deform;
        std::vector<char> beyond(block_count(model_.particles.count()));
        order_.walk([&](int b) { beyond[b] = loop(arrays, first_chunk(b), end_chunk(b)); },
                    [&](int b) { sum_forces_of_block(arrays, b, finish_block); });
        return true_places(beyond);
    }

    void recompute_forces(State<2>& state, const std::vector<int>& blocks,
                          const FinishBlock& finish_block) override {
        const kernel::Arrays arrays = bonds_.arrays(&state.force);
        const int count = static_cast<int>(blocks.size());
        parallel_blocks(
            count, [&](int k) { loops_.deform(arrays, first_chunk(blocks[k]), end_chunk(blocks[k])); });
        parallel_blocks(count, [&](int k) { sum_forces_of_block(arrays, blocks[k], finish_block); });
    }

    double energy(const State<2>& state) const override {
        const int n = model_.particles.count();
        parallel_for(n, [&](int begin, int end) { bonds_.read(state.displacement, begin, end); });
        const kernel::Arrays arrays = bonds_.arrays(nullptr);
        return parallel_sum<double>(
            n, [&](int begin, int end) { return loops_.energy(arrays, chunk(begin), chunk(end)); });
    }

    LocalState<2> local(const State<2>& state, int i) const override {
        LocalState<2> of = local(state, i, bonds_.lambda(i), [&](auto&& visit) { bonds_.each_bond(i, visit); });
        if (const auto gauge = first_gauge(i); gauge != gauges_.end() && gauge->particle == i) {
            const LocalState<2> measured =
                local(state, i, gauge->lambda, [&](auto&& visit) { each_bond(state, *gauge, visit); });
            of.stress = measured.stress;
            of.dilatation = measured.dilatation;
        }
        return of;
    }

    std::vector<LocalState<2>> local(const State<2>& state, int begin, int end) const override {
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
            local[gauge->particle - begin] = this->local(state, gauge->particle);
        return local;
    }

    void remove(int bond) override { bonds_.remove(model_.bonds.first[bond], model_.bonds.second[bond]); }

    std::unique_ptr<Tangent<2>> tangent(const State<2>& state) const override {
        return std::make_unique<Tangent<2>>(model_, state);
    }
    std::string name() const override { return "bond forces (moment-matched)"; }

 private:
    MomentMatched(const Model<2>& model, ElasticCoefficients coefficients, const BreakLimits& limits)
        : model_(model),
          bonds_(model, coefficients, limits),
          gauges_(std::move(coefficients.gauges)),
          order_(model.bonds),
          loops_(kernel::loops()),
          watches_(!limits.upper.empty()) {}

    /// each_bond(visit) calls visit(j, r0, s_ij / |r0|^2) for some bonds of particle i.
    template <class EachBond>
    LocalState<2> local(const State<2>& state, int i, double lambda, EachBond&& each_bond) const {
        const std::vector<Vec<2>>& u = state.displacement;
        const double mu = bonds_.two_mu(i) / 2, volume = bonds_.volume(i);
        double trace = 0, twist = 0, m = 0;
        each_bond([&](int j, const Vec<2>& r0, double own) {
            const Vec<2> du = u[j] - u[i], part = own * (1 / volume) * r0;
            trace += du.x() * part.x() + du.y() * part.y();
            twist += du.y() * part.x() - du.x() * part.y();
            m += own * r0.squaredNorm();
        });
        const PlaneRotation<double> p(trace, twist, m / volume);
        Mat<2> R;
        R << 1 + p.cosine_less_one, -p.sine, p.sine, 1 + p.cosine_less_one;
        // (R - I) r0: a small rotation keeps its digits
        const auto change = [&](const Vec<2>& r0) {
            return Vec<2>(p.cosine_less_one * r0.x() - p.sine * r0.y(),
                          p.sine * r0.x() + p.cosine_less_one * r0.y());
        };
        LocalState<2> of;
        Mat<2> strain = Mat<2>::Zero();  // sym(R^T A) - M, in the particle's own frame
        LargestStrain largest;
        each_bond([&](int j, const Vec<2>& r0, double own) {
            const Vec<2> du = u[j] - u[i], stretch = du - change(r0);  // the second r - R r0
            largest.look((2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm());
            of.energy += mu * own * stretch.squaredNorm();
            strain += own / volume * (R.transpose() * stretch) * r0.transpose();
        });
        strain = (strain + strain.transpose()).eval() / 2;
        of.dilatation = p.dilatation;
        of.bond_strain = largest.strain();
        of.energy += lambda * volume * p.dilatation * p.dilatation / 2;
        of.stress = R * (2 * mu * strain + lambda * p.dilatation * Mat<2>::Identity()) * R.transpose();
        return of;
    }

    /// The first of particle i or a later one.
    std::vector<Gauge>::const_iterator first_gauge(int i) const {
        return std::lower_bound(gauges_.begin(), gauges_.end(), i,
                                [](const Gauge& gauge, int particle) { return gauge.particle < particle; });
    }
    template <class Visit>
    void each_bond(const State<2>& state, const Gauge& gauge, Visit&& visit) const {
        const Bonds& bonds = model_.bonds;
        for (const auto& [b, s] : gauge.bonds) {
            if (!state.is_intact(b)) continue;
            const Vec<2> r0 = (bonds.first[b] == gauge.particle ? 1 : -1) * model_.bond_vectors[b];
            visit(bonds.other(b, gauge.particle), r0, s / r0.squaredNorm());
        }
    }

    /// Of a particle at the border of a block: blocks hold whole chunks.
    static int chunk(int particle) { return (particle + kernel::lanes - 1) / kernel::lanes; }
    static int first_chunk(int block) { return chunk(block * parallel_block); }
    int end_of(int block) const {
        return std::min((block + 1) * parallel_block, model_.particles.count());
    }
    int end_chunk(int block) const { return chunk(end_of(block)); }

    void sum_forces_of_block(const kernel::Arrays& arrays, int block, const FinishBlock& finish_block) const {
        loops_.sum_forces(arrays, first_chunk(block), end_chunk(block));
        if (finish_block) finish_block(block * parallel_block, end_of(block));
    }

    const Model<2>& model_;
    mutable CompactBonds bonds_;  ///< keeps a copy of the displacements
    std::vector<Gauge> gauges_;
    BlockOrder order_;
    const kernel::Loops& loops_;
    bool watches_;
};

}  // namespace

template <>
std::unique_ptr<ElasticLaw<2>> make_elastic_law<2>(const Model<2>& model, Elasticity elasticity,
                                                   const BreakLimits& limits) {
    if (elasticity == Elasticity::thesis) return make_thesis_law(model, limits);
    return std::make_unique<MomentMatched>(model, limits);
}

}  // namespace hibi
