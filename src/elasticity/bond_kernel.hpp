#pragma once
#include <compare>
#include <cstdint>

namespace hibi::kernel {

/// Particles are walked in chunks of this many consecutive ones, a lane each.
inline constexpr int lanes = 8;

// The numbers of a bond, seen from particle i towards j, by who needs them. Number is double where all
// particles of a chunk have them alike, or an array with a lane each: all zero then where a lane has no such
// bond, or it is broken.

template <class Number>
struct Deforming {
    Number ax{}, ay{};  ///< s_ij / (V |r0|^2) r0 (1/m): the bond's part in the deformation
    auto operator<=>(const Deforming&) const = default;
};

template <class Number>
struct Pulling {
    Number spring{};    ///< 2 mu_i s_ij / |r0|^2 + 2 mu_j s_ji / |r0|^2 (N/m)
    Number mx{}, my{};  ///< (s_ij + s_ji) / 2 / |r0|^2 r0 (m^2): the bond's part in the pull of both ends
    Number dx{}, dy{};  ///< (s_ij - s_ji) / 2 / |r0|^2 r0 (m^2): in their pulls' difference; 0 deep inside
    auto operator<=>(const Pulling&) const = default;
};

template <class Number>
struct Resting {
    Number x{}, y{};  ///< r0 (m)
    Number own{};     ///< s_ij / |r0|^2 (m)
    auto operator<=>(const Resting&) const = default;
};

/// Limits of L^2 - L0^2 (m^2); infinite where there is no bond.
template <class Number>
struct Limit {
    Number upper{}, lower{};
    auto operator<=>(const Limit&) const = default;
};

struct Kind {
    Deforming<double> deforming{};
    Pulling<double> pulling{};
    Resting<double> resting{};
    Limit<double> limit{};
    auto operator<=>(const Kind&) const = default;
};
using Lanes = double[lanes];

/// One bond of each of a chunk's particles, if the chunk is not gathered: that of lane l leads to particle
/// first + offset + l.
struct Record {
    std::int32_t offset = 0;
    std::int32_t kind = 0;  ///< into kinds, if the chunk is uniform
};

/// What the particles of a uniform chunk have in common, and what differs from lane to lane in all others.
struct Particle {
    double two_mu = 0, lambda = 0;  ///< (Pa)
    double volume = 0;              ///< V (m^3)
    double trace = 0;               ///< m_i [-]
    bool operator==(const Particle&) const = default;
};

struct Chunk {
    std::int32_t record = 0, records = 0;  ///< first of its records, and how many
    std::int32_t uniform = -1;             ///< its place in `uniform`, or -1
    bool symmetric = false;                ///< uniform, and s_ij = s_ji in all its bonds
    std::int32_t own_lanes = -1;           ///< if not uniform: first of its records in the arrays of lanes
    std::int32_t own_limits = -1;          ///< if its limits are not those of the kinds: first in `limit`
    std::int32_t neighbours = -1;          ///< if gathered: first of its neighbour lists, `lanes` per record
};

/// Everything the loops read and write. Arrays over particles begin at particle 0, and `lanes` further
/// elements exist before and behind.
struct Arrays {
    const Chunk* chunks = nullptr;
    const Record* records = nullptr;
    const Kind* kinds = nullptr;
    const Particle* uniform = nullptr;
    const Deforming<Lanes>* deforming = nullptr;
    const Pulling<Lanes>* pulling = nullptr;
    const Resting<Lanes>* resting = nullptr;
    const Limit<Lanes>* limit = nullptr;
    const std::int32_t* neighbours = nullptr;
    const double *two_mu = nullptr, *lambda = nullptr, *volume = nullptr,
                 *trace = nullptr;                 ///< as of Particle
    const double *ux = nullptr, *uy = nullptr;     ///< displacement (m)
    double *diagonal = nullptr, *twist = nullptr;  ///< P_i = -2 mu (R - I) + lambda D R (Pa)
    double* force = nullptr;                       ///< x, y of each particle in turn (N); no room around
    int particles = 0;
};

/// What one particle feels.
struct State {
    double energy = 0;                 ///< (J)
    double dilatation = 0;             ///< D_i [-]
    double xx = 0, yy = 0, xy = 0;     ///< Cauchy stress of the surviving bonds (Pa), current frame
    double longest = 0, shortest = 0;  ///< (L^2 - L0^2) / L0^2 of the bonds, 0 among them [-]
};

/// The loops for one kind of processor, over chunks [begin, end).
struct Loops {
    const char* level;  ///< of x86-64: "v2", "v3", "v4"; elsewhere "generic"
    /// Rotation and dilatation of every particle, as `diagonal` and `twist`. Returns whether some bond is
    /// beyond its limits; the first does not look.
    bool (*deform)(const Arrays&, int begin, int end);
    bool (*deform_and_watch)(const Arrays&, int begin, int end);
    void (*sum_forces)(const Arrays&, int begin, int end);
    /// Elastic energy (J), added in the order of the particles.
    double (*energy)(const Arrays&, int begin, int end);
    /// One state for every particle of the chunks, the last chunk's missing ones included.
    void (*states)(const Arrays&, int begin, int end, State* to);
};

/// The loops for the best level this processor has; all give the same bits. Environment variable
/// HIBI_CPU_LEVEL = v2 or v3 asks for a lower one.
const Loops& loops();

}  // namespace hibi::kernel
