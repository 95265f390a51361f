#include "elasticity/compact_bonds.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"

namespace hibi {

using kernel::Chunk;
using kernel::Kind;
using kernel::Lanes;
using kernel::lanes;
using kernel::Limit;
using kernel::Record;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Records with one neighbour list each instead of one offset, where offsets would take so many times more.
constexpr double too_many = 1.5;

void set(Limit<Lanes>& l, int lane, const Limit<double>& limit) {
    l.upper[lane] = limit.upper;
    l.lower[lane] = limit.lower;
}

constexpr Limit<double> no_limit{never, -never};

}  // namespace

CompactBonds::CompactBonds(const Model<2>& model, const ElasticCoefficients& coefficients,
                           const BreakLimits& limits)
    : watches_(!limits.upper.empty()), particles_(model.particles.count()) {
    const Particles<2>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const BondWeights& s = coefficients.s;
    const int chunks = (particles_ + lanes - 1) / lanes;
    for (std::vector<double>* field :
         {&two_mu_, &lambda_, &volume_, &trace_, &ux_, &uy_, &diagonal_, &twist_})
        field->assign((chunks + 2) * lanes, 0);
    std::fill(volume_.begin(), volume_.end(), 1);  // they are divided by
    for (int i = 0; i < particles_; ++i) {
        two_mu_[i + lanes] = 2 * shear_modulus(model.materials[particles.material[i]]);
        lambda_[i + lanes] = coefficients.lambda[i];
        volume_[i + lanes] = particles.volume[i];
    }

    const auto slot = [&](int b, int i) {
        const bool forward = bonds.first[b] == i;
        const Vec<2> r0 = (forward ? 1 : -1) * model.bond_vectors[b];
        const double square = r0.squaredNorm();
        const double own = (forward ? s.forward[b] : s.backward[b]) / square;
        const double other = (forward ? s.backward[b] : s.forward[b]) / square;
        const Vec<2> share = own / particles.volume[i] * r0;
        const Vec<2> mean = (own + other) / 2 * r0, half_difference = (own - other) / 2 * r0;
        const int j = bonds.other(b, i);
        return Slot{j,
                    {.deforming = {share.x(), share.y()},
                     .pulling = {own * two_mu(i) + other * two_mu(j), mean.x(), mean.y(), half_difference.x(),
                                 half_difference.y()},
                     .resting = {r0.x(), r0.y(), own},
                     .limit = watches_ ? Limit<double>{limits.upper[b] * square, limits.lower[b] * square}
                                       : no_limit}};
    };
    chunks_.resize(chunks);
    Slots slots;
    for (int c = 0; c < chunks; ++c) {
        const int first = c * lanes, last = std::min(particles_, first + lanes);
        for (std::vector<Slot>& of_lane : slots) of_lane.clear();
        for (int i = first; i < last; ++i) {
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k)
                slots[i - first].push_back(slot(bonds.bonds_of[k], i));
        }
        if (last < first + lanes || !add_uniform(slots, first, chunks_[c]))
            add_own_lanes(slots, first, chunks_[c]);
    }
    known_kinds_.clear();
}

/// If all particles of the chunk are alike. Most often they are as those of the last such chunk.
bool CompactBonds::add_uniform(const Slots& slots, int first, Chunk& chunk) {
    const std::size_t count = slots[0].size();
    bool same_limits = true;
    for (int l = 1; l < lanes; ++l) {
        if (slots[l].size() != count) return false;
        for (std::size_t k = 0; k < count; ++k) {
            if (slots[l][k].neighbour - slots[0][k].neighbour != l) return false;
            const Kind &bond = slots[l][k].bond, &first_bond = slots[0][k].bond;
            if (bond.deforming != first_bond.deforming || bond.pulling != first_bond.pulling ||
                bond.resting != first_bond.resting)
                return false;
            same_limits = same_limits && bond.limit == first_bond.limit;
        }
    }
    const auto kind = [&](std::size_t k) {
        Kind common = slots[0][k].bond;
        if (!same_limits) common.limit = no_limit;
        return common;
    };
    const Record* last = records_.data() + last_uniform_.record;
    bool as_last = last_uniform_.uniform >= 0 && last_uniform_.records == static_cast<int>(count);
    for (std::size_t k = 0; k < count && as_last; ++k)
        as_last = last[k].offset == slots[0][k].neighbour - first && kinds_[last[k].kind] == kind(k);
    if (!as_last) {
        last_uniform_ = {.record = static_cast<int>(records_.size()), .records = static_cast<int>(count)};
        for (std::size_t k = 0; k < count; ++k) {
            const auto [at, is_new] = known_kinds_.try_emplace(kind(k), static_cast<int>(kinds_.size()));
            if (is_new) kinds_.push_back(at->first);
            records_.push_back({slots[0][k].neighbour - first, at->second});
        }
    }
    chunk = last_uniform_;
    chunk.uniform = 0;  // any, for now: add_up walks its records
    for (int l = 0; l < lanes; ++l) add_up(first + l);
    const kernel::Particle common = particle(first);
    for (int l = 1; l < lanes; ++l)
        if (!(particle(first + l) == common)) return false;
    if (uniform_.empty() || !(uniform_.back() == common)) uniform_.push_back(common);
    chunk.uniform = last_uniform_.uniform = static_cast<int>(uniform_.size()) - 1;
    chunk.symmetric = std::all_of(slots[0].begin(), slots[0].end(), [](const Slot& slot) {
        return slot.bond.pulling.dx == 0 && slot.bond.pulling.dy == 0;
    });
    if (!same_limits) give_own_limits(slots, first, chunk);
    return true;
}

void CompactBonds::add_own_lanes(const Slots& slots, int first, Chunk& chunk) {
    std::vector<int> offsets;
    std::size_t most = 0;
    for (int l = 0; l < lanes; ++l) {
        most = std::max(most, slots[l].size());
        for (const Slot& slot : slots[l]) offsets.push_back(slot.neighbour - first - l);
    }
    std::sort(offsets.begin(), offsets.end());
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
    const bool gathered = static_cast<double>(offsets.size()) > too_many * static_cast<double>(most) + 2;
    const std::size_t count = gathered ? most : offsets.size();

    chunk = {.record = static_cast<int>(records_.size()),
             .records = static_cast<int>(count),
             .own_lanes = static_cast<int>(resting_.size()),
             .neighbours = gathered ? static_cast<int>(neighbours_.size()) : -1};
    deforming_.resize(resting_.size() + count);
    pulling_.resize(resting_.size() + count);
    resting_.resize(resting_.size() + count);
    if (gathered) {
        for (std::size_t k = 0; k < count; ++k) {
            for (int l = 0; l < lanes; ++l) {
                const bool exists = k < slots[l].size();
                neighbours_.push_back(exists ? slots[l][k].neighbour : first + l);
                if (exists) set_lane(chunk.own_lanes + static_cast<int>(k), l, slots[l][k].bond);
            }
        }
    } else {
        for (const int offset : offsets) records_.push_back({.offset = offset});
        for (int l = 0; l < lanes; ++l)
            for (const Slot& slot : slots[l])
                set_lane(chunk.own_lanes + record_of(chunk, first + l, slot.neighbour), l, slot.bond);
    }
    for (int l = 0; l < lanes && first + l < particles_; ++l) add_up(first + l);
    if (watches_) give_own_limits(slots, first, chunk);
}

void CompactBonds::give_own_limits(const Slots& slots, int first, Chunk& chunk) {
    chunk.own_limits = static_cast<int>(limit_.size());
    limit_.resize(limit_.size() + chunk.records);
    for (int l = 0; l < lanes; ++l) {
        for (int r = 0; r < chunk.records; ++r) set(limit_[chunk.own_limits + r], l, no_limit);
        for (const Slot& slot : slots[l])
            set(limit_[chunk.own_limits + record_of(chunk, first + l, slot.neighbour)], l, slot.bond.limit);
    }
}

/// What was uniform is so no longer.
void CompactBonds::give_own_lanes(Chunk& chunk) {
    const Record* const record = records_.data() + chunk.record;
    chunk.uniform = -1;
    chunk.symmetric = false;
    chunk.own_lanes = static_cast<int>(resting_.size());
    for (int r = 0; r < chunk.records; ++r) {
        deforming_.emplace_back();
        pulling_.emplace_back();
        resting_.emplace_back();
        for (int l = 0; l < lanes; ++l) set_lane(chunk.own_lanes + r, l, kinds_[record[r].kind]);
    }
    if (!watches_ || chunk.own_limits >= 0) return;
    chunk.own_limits = static_cast<int>(limit_.size());
    for (int r = 0; r < chunk.records; ++r) {
        Limit<Lanes>& own = limit_.emplace_back();
        for (int l = 0; l < lanes; ++l) set(own, l, kinds_[record[r].kind].limit);
    }
}

void CompactBonds::set_lane(int record, int lane, const Kind& bond) {
    deforming_[record].ax[lane] = bond.deforming.ax;
    deforming_[record].ay[lane] = bond.deforming.ay;
    pulling_[record].spring[lane] = bond.pulling.spring;
    pulling_[record].mx[lane] = bond.pulling.mx;
    pulling_[record].my[lane] = bond.pulling.my;
    pulling_[record].dx[lane] = bond.pulling.dx;
    pulling_[record].dy[lane] = bond.pulling.dy;
    resting_[record].x[lane] = bond.resting.x;
    resting_[record].y[lane] = bond.resting.y;
    resting_[record].own[lane] = bond.resting.own;
}

/// Of the bond of i to j.
int CompactBonds::record_of(const Chunk& chunk, int i, int j) const {
    int r = 0;
    while (neighbour(chunk, r, i) != j) ++r;
    return r;
}

void CompactBonds::read(const std::vector<Vec<2>>& displacement, int begin, int end) {
    for (int i = begin; i < end; ++i) {
        ux_[i + lanes] = displacement[i].x();
        uy_[i + lanes] = displacement[i].y();
    }
}

void CompactBonds::remove(int first, int second) {
    for (const auto& [i, j] : {std::pair{first, second}, std::pair{second, first}}) {
        Chunk& chunk = chunks_[i / lanes];
        if (chunk.uniform >= 0) give_own_lanes(chunk);
        const int r = record_of(chunk, i, j);
        set_lane(chunk.own_lanes + r, i % lanes, {});
        if (watches_) set(limit_[chunk.own_limits + r], i % lanes, no_limit);
        add_up(i);
    }
}

/// m_i sums alive bonds only: with d in its place a resting fragment would carry a false pressure.
void CompactBonds::add_up(int i) {
    double trace = 0;
    each_bond(i, [&](int, const Vec<2>& r0, double own) { trace += own * r0.squaredNorm(); });
    trace_[i + lanes] = trace / volume(i);
}

kernel::Particle CompactBonds::particle(int i) const { return {two_mu(i), lambda(i), volume(i), trace(i)}; }

kernel::Arrays CompactBonds::arrays(std::vector<Vec<2>>* force) {
    return {.chunks = chunks_.data(),
            .records = records_.data(),
            .kinds = kinds_.data(),
            .uniform = uniform_.data(),
            .deforming = deforming_.data(),
            .pulling = pulling_.data(),
            .resting = resting_.data(),
            .limit = limit_.data(),
            .neighbours = neighbours_.data(),
            .two_mu = two_mu_.data() + lanes,
            .lambda = lambda_.data() + lanes,
            .volume = volume_.data() + lanes,
            .trace = trace_.data() + lanes,
            .ux = ux_.data() + lanes,
            .uy = uy_.data() + lanes,
            .diagonal = diagonal_.data() + lanes,
            .twist = twist_.data() + lanes,
            .force = force ? force->front().data() : nullptr,
            .particles = particles_};
}

}  // namespace hibi
