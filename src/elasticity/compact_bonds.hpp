#pragma once
#include <array>
#include <map>
#include <vector>

#include "model/model.hpp"
#include "elasticity/bond_kernel.hpp"
#include "elasticity/elastic_coefficients.hpp"
#include "elasticity/elastic_law.hpp"

namespace hibi {

/// The bonds of a moment-matched model in the form the fast loops walk (bond_kernel.hpp), each bond from both
/// its ends. Where consecutive particles have the same bonds, as in the rows of a lattice, these are stored
/// once.
class CompactBonds {
 public:
    /// Without limits nothing is watched.
    CompactBonds(const Model<2>& model, const ElasticCoefficients& coefficients, const BreakLimits& limits);

    /// Takes over the displacements of particles [begin, end).
    void read(const std::vector<Vec<2>>& displacement, int begin, int end);

    /// The bond between the two carries nothing from now on.
    void remove(int first, int second);

    /// For the loops, which will write to `force`; valid until the next call of remove.
    kernel::Arrays arrays(std::vector<Vec<2>>* force);

    /// Calls visit(j, r0, s_ij / |r0|^2) for each alive bond of particle i, in rising order of j.
    template <class Visit>
    void each_bond(int i, Visit&& visit) const {
        const kernel::Chunk& chunk = chunks_[i / kernel::lanes];
        const int lane = i % kernel::lanes;
        for (int r = 0; r < chunk.records; ++r) {
            if (chunk.uniform >= 0) {
                const kernel::Record& record = records_[chunk.record + r];
                const kernel::Resting<double>& bond = kinds_[record.kind].resting;
                visit(i + record.offset, Vec<2>(bond.x, bond.y), bond.own);
            } else if (const kernel::Resting<kernel::Lanes>& l = resting_[chunk.own_lanes + r];
                       l.own[lane] != 0) {
                visit(neighbour(chunk, r, i), Vec<2>(l.x[lane], l.y[lane]), l.own[lane]);
            }
        }
    }

    // As of kernel::Particle.
    double two_mu(int i) const { return two_mu_[i + kernel::lanes]; }
    double lambda(int i) const { return lambda_[i + kernel::lanes]; }
    double volume(int i) const { return volume_[i + kernel::lanes]; }
    double trace(int i) const { return trace_[i + kernel::lanes]; }

 private:
    /// A bond, seen from one of its ends.
    struct Slot {
        int neighbour = 0;
        kernel::Kind bond;
    };
    using Slots = std::array<std::vector<Slot>, kernel::lanes>;  ///< of a chunk's particles

    bool add_uniform(const Slots& slots, int first, kernel::Chunk& chunk);
    void add_own_lanes(const Slots& slots, int first, kernel::Chunk& chunk);
    void give_own_lanes(kernel::Chunk& chunk);
    void give_own_limits(const Slots& slots, int first, kernel::Chunk& chunk);
    void set_lane(int record, int lane, const kernel::Kind& bond);
    void add_up(int i);
    int record_of(const kernel::Chunk& chunk, int i, int j) const;
    kernel::Particle particle(int i) const;
    int neighbour(const kernel::Chunk& chunk, int r, int i) const {
        return chunk.neighbours < 0 ? i + records_[chunk.record + r].offset
                                    : neighbours_[chunk.neighbours + r * kernel::lanes + i % kernel::lanes];
    }

    std::vector<kernel::Chunk> chunks_;
    std::vector<kernel::Record> records_;
    std::vector<kernel::Kind> kinds_;
    std::map<kernel::Kind, int> known_kinds_;
    std::vector<kernel::Particle> uniform_;
    std::vector<kernel::Deforming<kernel::Lanes>> deforming_;
    std::vector<kernel::Pulling<kernel::Lanes>> pulling_;
    std::vector<kernel::Resting<kernel::Lanes>> resting_;
    std::vector<kernel::Limit<kernel::Lanes>> limit_;
    std::vector<std::int32_t> neighbours_;
    kernel::Chunk last_uniform_;
    bool watches_;
    int particles_ = 0;
    /// Per particle, with room before and behind.
    std::vector<double> two_mu_, lambda_, volume_, trace_, ux_, uy_, diagonal_, twist_;
};

}  // namespace hibi
