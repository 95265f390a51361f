#include "scene/load_direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scene/expression.hpp"

namespace hibi {

namespace {

constexpr int most_scales = 32, between_knots = 4, spread = 1000, most_particles = 64;
constexpr double about_largest = 0.99;
constexpr double only_rounding = 1e-9;  // of what was added up

/// Total of a load at a time, ramp left aside, over every `stride`-th particle. `gross` adds up sizes.
Vec3 total(const Model<2>& model, const Load& load, double time, std::size_t stride = 1,
           double* gross = nullptr) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < load.particles.size(); k += stride) {
        const Vec3 X = to_3d<2>(model.particles.reference_position[load.particles[k]]);
        Vec3 part = Vec3::Zero();
        if (load.kind == Load::Kind::pressure)
            part = -load.value[0](X, time) * load.share[k];
        else
            for (int axis = 0; axis < 2; ++axis)
                part[axis] =
                    (load.kind == Load::Kind::force ? load.share[k].x() : 1.0) * load.value[axis](X, time);
        sum += part;
        if (gross) *gross += part.norm();
    }
    return sum;
}

/// Times that the formulas of a load speak of: its constants with the dimension of time, the inverse of
/// rates, and multiples of both by its plain numbers.
std::vector<double> time_scales(const Load& load) {
    std::set<double> plain{1}, times, scales;
    for (const Field& value : load.value) {
        if (!value.varies_in_time()) continue;
        for (const Instruction& part :
             parse_expression(value.text(), Names{.space = true, .time = true}).program) {
            const double size = std::abs(part.value);
            if (part.op != Op::constant || size == 0) continue;
            if (part.dimension.is_plain()) plain.insert(size);
            if (part.dimension == dimension_of("s")) times.insert(size);
            if (part.dimension == dimension_of("1/s")) times.insert(1 / size);
        }
    }
    for (const double factor : plain)
        for (const double time : times)
            if (scales.size() < most_scales) scales.insert(factor * time);
    return {scales.begin(), scales.end()};
}

/// Times at which a load is looked at, in order. A short pulse begins, peaks or ends at sums and differences
/// of the times its formula speaks of, or between two of them. Others are spread over the run as the golden
/// ratio has them, so that no oscillation keeps step with them.
std::vector<double> times_to_look_at(const Load& load, double end) {
    std::set<double> knots{0, std::min(load.ramp.duration, end), end};
    const std::vector<double> scales = time_scales(load);
    for (const double a : scales) {
        knots.insert(a);
        for (const double b : scales) knots.insert({a + b, std::abs(a - b)});
    }
    std::vector<double> times;
    for (auto knot = knots.begin(); knot != knots.end() && *knot <= end; ++knot) {
        times.push_back(*knot);
        const auto next = std::next(knot);
        if (next == knots.end()) break;
        for (int k = 1; k <= between_knots; ++k)
            times.push_back(*knot + (*next - *knot) * k / (between_knots + 1));
    }
    for (int k = 1; k <= spread; ++k) {
        const double turns = k / std::numbers::phi;
        times.push_back(end * (turns - std::floor(turns)));
    }
    std::erase_if(times, [&](double t) { return t > end; });
    std::sort(times.begin(), times.end());
    return times;
}

/// When to take the direction.
double telling_time(const Model<2>& model, const Load& load, double end) {
    const double full = load.ramp.duration;
    const bool varies = std::any_of(load.value.begin(), load.value.end(),
                                    [](const Field& value) { return value.varies_in_time(); });
    if (!varies) return full;
    const std::size_t stride = 1 + load.particles.size() / most_particles;
    const auto size = [&](double time) {
        const double norm = load.ramp(time) * total(model, load, time, stride).norm();
        return std::isfinite(norm) ? norm : 0;
    };
    std::vector<double> times = times_to_look_at(load, end), sizes;
    for (const double time : times) sizes.push_back(size(time));
    const double enough = about_largest * *std::max_element(sizes.begin(), sizes.end());
    if (enough == 0 || size(full) >= enough) return full;
    return times[std::find_if(sizes.begin(), sizes.end(), [&](double s) { return s >= enough; }) -
                 sizes.begin()];
}

}  // namespace

std::optional<Vec3> load_direction(const Model<2>& model, const Load& load, double end) {
    const auto direction_at = [&](double time) -> std::optional<Vec3> {
        double gross = 0;
        const Vec3 sum = total(model, load, time, 1, &gross);
        if (!sum.allFinite() || !(sum.norm() > only_rounding * gross)) return {};
        return sum.normalized();
    };
    const auto at_full_ramp = direction_at(load.ramp.duration);
    const auto direction = direction_at(telling_time(model, load, end));
    // Of the same direction at two times the rounding differs.
    const bool same = at_full_ramp && direction && (*at_full_ramp - *direction).norm() < only_rounding;
    return same ? at_full_ramp : direction;
}

}  // namespace hibi
