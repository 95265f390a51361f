// The loops over the bonds, compiled once per level of the processor: HIBI_LEVEL is the namespace. Nothing
// but std::experimental::simd and plain pointers may be used here: an inline function shared with the rest of
// the program could be the one that the linker keeps, and needs this level's processor.
#include <experimental/simd>

#include "elasticity/bond_kernel.hpp"
#include "elasticity/plane_rotation.hpp"

namespace hibi::kernel::HIBI_LEVEL {

namespace {

namespace stdx = std::experimental;
using Register = stdx::native_simd<double>;
constexpr int width = static_cast<int>(Register::size());
constexpr int registers = lanes / width;
static_assert(registers * width == lanes);
#define HIBI_NAME_OF(level) #level
#define HIBI_NAME(level) HIBI_NAME_OF(level)
#define HIBI_INLINE [[gnu::always_inline]] inline

/// One number for each particle of a chunk.
struct Chunkful {
    Register part[registers];
    HIBI_INLINE Chunkful() = default;
    HIBI_INLINE Chunkful(double same) {
        for (Register& p : part) p = same;
    }
    HIBI_INLINE explicit Chunkful(const double* from) {
        for (int k = 0; k < registers; ++k) part[k].copy_from(from + k * width, stdx::element_aligned);
    }
    HIBI_INLINE Chunkful(const double* from, const std::int32_t* at) {
        for (int k = 0; k < registers; ++k)
            part[k] = Register([&](auto lane) { return from[at[k * width + lane]]; });
    }
    HIBI_INLINE void store(double* to) const {
        for (int k = 0; k < registers; ++k) part[k].copy_to(to + k * width, stdx::element_aligned);
    }
};
template <class Of>
HIBI_INLINE Chunkful each(Of&& of) {
    Chunkful r;
    for (int k = 0; k < registers; ++k) r.part[k] = of(k);
    return r;
}
HIBI_INLINE Chunkful operator+(const Chunkful& a, const Chunkful& b) {
    return each([&](int k) { return a.part[k] + b.part[k]; });
}
HIBI_INLINE Chunkful operator-(const Chunkful& a, const Chunkful& b) {
    return each([&](int k) { return a.part[k] - b.part[k]; });
}
HIBI_INLINE Chunkful operator*(const Chunkful& a, const Chunkful& b) {
    return each([&](int k) { return a.part[k] * b.part[k]; });
}
HIBI_INLINE Chunkful operator/(const Chunkful& a, const Chunkful& b) {
    return each([&](int k) { return a.part[k] / b.part[k]; });
}

/// What holds for some particles of a chunk.
struct Some {
    Register::mask_type part[registers] = {};
    HIBI_INLINE void add(const Some& other) {
        for (int k = 0; k < registers; ++k) part[k] = part[k] || other.part[k];
    }
    HIBI_INLINE bool any() const {
        bool some = false;
        for (int k = 0; k < registers; ++k) some = some || stdx::any_of(part[k]);
        return some;
    }
};
/// Is `value` outside [lower, upper]? Not where it is no number.
HIBI_INLINE Some outside(const Chunkful& value, const Chunkful& lower, const Chunkful& upper) {
    Some s;
    for (int k = 0; k < registers; ++k)
        s.part[k] = value.part[k] > upper.part[k] || value.part[k] < lower.part[k];
    return s;
}

/// Neighbours' numbers, by one load or lane by lane.
struct Neighbours {
    int first = 0;
    const std::int32_t* at = nullptr;
    HIBI_INLINE Chunkful operator()(const double* from) const {
        return at ? Chunkful(from, at) : Chunkful(from + first);
    }
};

/// A record of a uniform chunk.
struct Common {
    const Kind& kind;
    HIBI_INLINE const Deforming<double>& deforming() const { return kind.deforming; }
    HIBI_INLINE const Pulling<double>& pulling() const { return kind.pulling; }
    HIBI_INLINE const Resting<double>& resting() const { return kind.resting; }
};
/// A record of any other.
struct Own {
    const Arrays& a;
    int at;
    HIBI_INLINE const Deforming<Lanes>& deforming() const { return a.deforming[at]; }
    HIBI_INLINE const Pulling<Lanes>& pulling() const { return a.pulling[at]; }
    HIBI_INLINE const Resting<Lanes>& resting() const { return a.resting[at]; }
};

/// Calls visit(neighbours, bond, r) for every record r of a chunk, with bond Common or Own.
template <class Visit>
HIBI_INLINE void each_record(const Arrays& a, int c, Visit&& visit) {
    const Chunk& chunk = a.chunks[c];
    const Record* record = a.records + chunk.record;
    if (chunk.uniform >= 0)
        for (int r = 0; r < chunk.records; ++r)
            visit(Neighbours{c * lanes + record[r].offset}, Common{a.kinds[record[r].kind]}, r);
    else if (chunk.neighbours < 0)
        for (int r = 0; r < chunk.records; ++r)
            visit(Neighbours{c * lanes + record[r].offset}, Own{a, chunk.own_lanes + r}, r);
    else
        for (int r = 0; r < chunk.records; ++r)
            visit(Neighbours{0, a.neighbours + chunk.neighbours + r * lanes}, Own{a, chunk.own_lanes + r}, r);
}

HIBI_INLINE Chunkful of(const Arrays& a, int c, const double* each, double Particle::*common) {
    const int u = a.chunks[c].uniform;
    return u >= 0 ? Chunkful(a.uniform[u].*common) : Chunkful(each + c * lanes);
}

/// tr(A - M) and A21 - A12.
struct Deformation {
    Chunkful trace = 0.0, twist = 0.0;
};

template <bool Watch>
HIBI_INLINE Deformation deformation(const Arrays& a, int c, Some& beyond) {
    const int i = c * lanes;
    const Chunkful ux(a.ux + i), uy(a.uy + i);
    const Chunk& chunk = a.chunks[c];
    const Record* record = a.records + chunk.record;
    Deformation h;
    each_record(a, c, [&](const Neighbours& neighbours, const auto& bond, int r) {
        const Chunkful dx = neighbours(a.ux) - ux, dy = neighbours(a.uy) - uy;
        const Chunkful bx(bond.deforming().ax), by(bond.deforming().ay);
        h.trace = h.trace + (dx * bx + dy * by);
        h.twist = h.twist + (dy * bx - dx * by);
        if constexpr (Watch) {
            // From one end is enough: that towards higher particles.
            if (chunk.neighbours < 0 && record[r].offset < 0) return;
            const Chunkful x(bond.resting().x), y(bond.resting().y);
            const Chunkful growth = 2.0 * (dx * x + dy * y) + (dx * dx + dy * dy);  // L^2 - L0^2
            if (chunk.own_limits < 0) {
                const Limit<double>& limit = a.kinds[record[r].kind].limit;
                beyond.add(outside(growth, limit.lower, limit.upper));
            } else {
                const Limit<Lanes>& limit = a.limit[chunk.own_limits + r];
                beyond.add(outside(growth, Chunkful(limit.lower), Chunkful(limit.upper)));
            }
        }
    });
    return h;
}

/// Of every particle of a chunk, see PlaneRotation.
struct Rotation {
    Chunkful cosine_less_one, sine, dilatation;
    HIBI_INLINE Rotation(const Deformation& h, const Chunkful& m) {
        for (int k = 0; k < registers; ++k) {
            const PlaneRotation<Register> p(h.trace.part[k], h.twist.part[k], m.part[k]);
            cosine_less_one.part[k] = p.cosine_less_one;
            sine.part[k] = p.sine;
            dilatation.part[k] = p.dilatation;
        }
    }
};

template <bool Watch>
bool deform(const Arrays& a, int begin, int end) {
    Some beyond;
    for (int c = begin; c < end; ++c) {
        const Rotation p(deformation<Watch>(a, c, beyond), of(a, c, a.trace, &Particle::trace));
        const Chunkful two_mu = of(a, c, a.two_mu, &Particle::two_mu);
        const Chunkful pressure = of(a, c, a.lambda, &Particle::lambda) * p.dilatation;
        const Chunkful cosine = 1.0 + p.cosine_less_one;
        (pressure * cosine - two_mu * p.cosine_less_one).store(a.diagonal + c * lanes);
        (pressure * p.sine - two_mu * p.sine).store(a.twist + c * lanes);
    }
    return beyond.any();
}

/// f_i = sum_j [ spring du + (s_ij P_i + s_ji P_j) r0 / |r0|^2 ], the second by the mean and the difference
/// of s_ij and s_ji: the force is then the opposite of that on the other end to the last bit.
template <bool Symmetric>
HIBI_INLINE void force_on(const Arrays& a, int c) {
    const int i = c * lanes;
    const Chunkful ux(a.ux + i), uy(a.uy + i), diagonal(a.diagonal + i), twist(a.twist + i);
    Chunkful fx = 0.0, fy = 0.0;
    each_record(a, c, [&](const Neighbours& neighbours, const auto& bond, int) {
        const auto& b = bond.pulling();
        const Chunkful dx = neighbours(a.ux) - ux, dy = neighbours(a.uy) - uy;
        const Chunkful other_diagonal = neighbours(a.diagonal), other_twist = neighbours(a.twist);
        const Chunkful spring(b.spring), mx(b.mx), my(b.my);
        const Chunkful d = diagonal + other_diagonal, t = twist + other_twist;
        Chunkful px = d * mx - t * my, py = d * my + t * mx;
        if constexpr (!Symmetric) {
            const Chunkful x(b.dx), y(b.dy);
            const Chunkful dd = diagonal - other_diagonal, dt = twist - other_twist;
            px = px + (dd * x - dt * y);
            py = py + (dd * y + dt * x);
        }
        fx = fx + (spring * dx + px);
        fy = fy + (spring * dy + py);
    });
    double x[lanes], y[lanes];
    fx.store(x);
    fy.store(y);
    const int count = a.particles - i < lanes ? a.particles - i : lanes;
    for (int l = 0; l < count; ++l) {
        a.force[2 * (i + l)] = x[l];
        a.force[2 * (i + l) + 1] = y[l];
    }
}

void sum_forces(const Arrays& a, int begin, int end) {
    for (int c = begin; c < end; ++c) {
        if (a.chunks[c].symmetric)
            force_on<true>(a, c);
        else
            force_on<false>(a, c);
    }
}

/// Largest and smallest (L^2 - L0^2) / L0^2 of some bonds, and 0.
struct Growth {
    Chunkful longest = 0.0, shortest = 0.0;
    HIBI_INLINE void look(const Chunkful& growth, const Chunkful& square) {
        for (int k = 0; k < registers; ++k) {
            Register g = growth.part[k] / square.part[k];
            stdx::where(square.part[k] == 0, g) = 0.0;  // no bond
            stdx::where(g > longest.part[k], longest.part[k]) = g;
            stdx::where(g < shortest.part[k], shortest.part[k]) = g;
        }
    }
};

/// R^T sum_j s_ij / |r0|^2 (r - R r0) (x) r0, which is V times the strain before it is made symmetric.
struct Strain {
    Chunkful xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
};

/// U_i = mu sum_j s_ij |r - R_i r0|^2 / |r0|^2 + lambda V D_i^2 / 2, and with states the stress
/// R (2 mu strain + lambda D I) R^T and the extreme bonds.
template <bool WithStates>
HIBI_INLINE Chunkful energy_of(const Arrays& a, int c, State* states) {
    Some none;
    const Rotation p(deformation<false>(a, c, none), of(a, c, a.trace, &Particle::trace));
    const int i = c * lanes;
    const Chunkful ux(a.ux + i), uy(a.uy + i);
    Chunkful springs = 0.0;
    Strain v;  // r - R r0 in place of its R^T multiple
    Growth growth;
    each_record(a, c, [&](const Neighbours& neighbours, const auto& bond, int) {
        const Chunkful x(bond.resting().x), y(bond.resting().y), own(bond.resting().own);
        const Chunkful dux = neighbours(a.ux) - ux, duy = neighbours(a.uy) - uy;
        const Chunkful dx = dux - (p.cosine_less_one * x - p.sine * y);
        const Chunkful dy = duy - (p.sine * x + p.cosine_less_one * y);
        springs = springs + own * (dx * dx + dy * dy);
        if constexpr (WithStates) {
            const Chunkful sx = own * x, sy = own * y;
            v.xx = v.xx + dx * sx;
            v.xy = v.xy + dx * sy;
            v.yx = v.yx + dy * sx;
            v.yy = v.yy + dy * sy;
            growth.look(2.0 * (x * dux + y * duy) + (dux * dux + duy * duy), x * x + y * y);
        }
    });
    const Chunkful two_mu = of(a, c, a.two_mu, &Particle::two_mu);
    const Chunkful lambda = of(a, c, a.lambda, &Particle::lambda);
    const Chunkful volume = of(a, c, a.volume, &Particle::volume);
    const Chunkful energy = 0.5 * (two_mu * springs + lambda * volume * (p.dilatation * p.dilatation));
    if constexpr (WithStates) {
        const Chunkful cosine = 1.0 + p.cosine_less_one, per_volume = 1.0 / volume;
        const Chunkful exx = (cosine * v.xx + p.sine * v.yx) * per_volume;
        const Chunkful eyy = (cosine * v.yy - p.sine * v.xy) * per_volume;
        const Chunkful exy =
            0.5 * ((cosine * v.xy + p.sine * v.yy) + (cosine * v.yx - p.sine * v.xx)) * per_volume;
        const Chunkful pressure = lambda * p.dilatation;
        const Chunkful sxx = two_mu * exx + pressure, syy = two_mu * eyy + pressure, sxy = two_mu * exy;
        const Chunkful cc = cosine * cosine, ss = p.sine * p.sine, cs = cosine * p.sine;
        double energies[lanes], dilatation[lanes], xx[lanes], yy[lanes], xy[lanes];
        double longest[lanes], shortest[lanes];
        growth.longest.store(longest);
        growth.shortest.store(shortest);
        energy.store(energies);
        p.dilatation.store(dilatation);
        (cc * sxx - 2.0 * cs * sxy + ss * syy).store(xx);
        (ss * sxx + 2.0 * cs * sxy + cc * syy).store(yy);
        (cs * (sxx - syy) + (cc - ss) * sxy).store(xy);
        for (int l = 0; l < lanes; ++l)
            states[l] = {energies[l], dilatation[l], xx[l], yy[l], xy[l], longest[l], shortest[l]};
    }
    return energy;
}

double energy(const Arrays& a, int begin, int end) {
    double sum = 0;
    for (int c = begin; c < end; ++c) {
        double of_lane[lanes];
        energy_of<false>(a, c, nullptr).store(of_lane);
        for (const double e : of_lane) sum += e;
    }
    return sum;
}

void states(const Arrays& a, int begin, int end, State* to) {
    for (int c = begin; c < end; ++c) energy_of<true>(a, c, to + (c - begin) * lanes);
}

}  // namespace

extern const Loops loops;
const Loops loops{HIBI_NAME(HIBI_LEVEL), deform<false>, deform<true>, sum_forces, energy, states};

}  // namespace hibi::kernel::HIBI_LEVEL
