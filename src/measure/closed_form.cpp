#include "measure/closed_form.hpp"

#include <cmath>
#include <functional>
#include <numbers>

namespace hibi {

namespace {

using std::numbers::pi;

/// Root of f between low and high, at which f has different signs.
double root_between(double low, double high, const std::function<double(double)>& f) {
    const bool rising = f(low) < 0;
    for (int k = 0; k < 200 && low < high; ++k) {
        const double middle = (low + high) / 2;
        if (middle == low || middle == high) break;
        ((f(middle) < 0) == rising ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// The functions of x that satisfy Timoshenko's equations at one frequency: deflection cosh(a x), sinh(a x),
/// cos(b x), sin(b x), and with them the turning of the section p sinh, p cosh, -q sin, q cos.
struct Waves {
    double a, b, p, q;
};

Waves waves_at(double frequency, const TimoshenkoBeam& beam) {
    const auto [E, nu] = beam.material;
    const double shear = 10 * (1 + nu) / (12 + 11 * nu) * E / (2 * (1 + nu));  // kappa G
    const double square = beam.density * frequency * frequency;
    const double by_turning = square / E, by_shear = square / shear;
    const double stiff = 12 * square / (E * beam.height * beam.height);  // rho A w^2 / (E I)
    const double mean = (by_turning + by_shear) / 2;
    const double root = std::sqrt(std::pow((by_turning - by_shear) / 2, 2) + stiff);
    Waves w{};
    w.a = std::sqrt(root - mean);
    w.b = std::sqrt(root + mean);
    w.p = w.a + by_shear / w.a;
    w.q = w.b - by_shear / w.b;
    return w;
}

/// The frequency of a slender beam with that root k L of its equation: that of a thicker one is lower.
double slender_frequency(double kL, const TimoshenkoBeam& beam) {
    return std::pow(kL / beam.length, 2) * beam.height *
           std::sqrt(beam.material.youngs_modulus / (12 * beam.density));
}

/// The slowest vibration at which `condition` vanishes, the slender beam's root being k L.
double longest_period(double kL, const TimoshenkoBeam& beam,
                      const std::function<double(const Waves&)>& condition) {
    const double slender = slender_frequency(kL, beam);
    const auto f = [&](double frequency) { return condition(waves_at(frequency, beam)); };
    return 2 * pi / root_between(0.3 * slender, 1.0001 * slender, f);
}

}  // namespace

PlaneConstants plane_strain(double youngs_modulus, double poissons_ratio) {
    return {youngs_modulus / (1 - poissons_ratio * poissons_ratio), poissons_ratio / (1 - poissons_ratio)};
}

Vec<2> cantilever_displacement(double x, double y, double force, double length, double height,
                               PlaneConstants material) {
    const auto [E, nu] = material;
    const double scale = 2 * force / (E * height * height * height);  // P / (6 E I)
    return scale * Vec<2>(-y * ((6 * length - 3 * x) * x + (2 + nu) * (y * y - height * height / 4)),
                          3 * nu * y * y * (length - x) + (4 + 5 * nu) * height * height * x / 4 +
                              (3 * length - x) * x * x);
}

double free_free_period(const TimoshenkoBeam& beam) {
    // The first mode is even: cosh and cos about the middle, without moment and shear at the end.
    return longest_period(4.730041, beam, [&](const Waves& w) {
        const double h = beam.length / 2;
        return w.p * w.a * std::cosh(w.a * h) * (w.q - w.b) * std::sin(w.b * h) +
               w.q * w.b * std::cos(w.b * h) * (w.a - w.p) * std::sinh(w.a * h);
    });
}

double clamped_free_period(const TimoshenkoBeam& beam) {
    // Without deflection and turning at the root: cosh - cos and q sinh - p sin; without moment and shear at
    // the end.
    return longest_period(1.875104, beam, [&](const Waves& w) {
        const double L = beam.length;
        const double ch = std::cosh(w.a * L), sh = std::sinh(w.a * L), c = std::cos(w.b * L),
                     s = std::sin(w.b * L);
        const double moment_1 = w.p * w.a * ch + w.q * w.b * c;
        const double moment_2 = w.q * w.p * w.a * sh + w.p * w.q * w.b * s;
        const double shear_1 = (w.a - w.p) * sh + (w.b - w.q) * s;
        const double shear_2 = w.q * (w.a - w.p) * ch - w.p * (w.b - w.q) * c;
        return moment_1 * shear_2 - moment_2 * shear_1;
    });
}

double clamped_plate_period(double length, double height, double youngs_modulus, double density) {
    return 0.9954 * clamped_free_period({length, height, density, plane_strain(youngs_modulus, 0.3975)});
}

double bar_period(double length, double height, double density, PlaneConstants material) {
    const double swelling = material.poissons_ratio * pi / length * height;
    return 2 * length * std::sqrt(density / material.youngs_modulus * (1 + swelling * swelling / 12));
}

Vec<2> elastica_end(double load) {
    const auto modulus = [](double slope) { return std::sqrt((1 + std::sin(slope)) / 2); };
    const auto from = [](double k) { return std::asin(1 / (k * std::numbers::sqrt2)); };
    const double root = std::sqrt(load);
    const double slope = root_between(1e-12, pi / 2 - 1e-12, [&](double angle) {
        const double k = modulus(angle);
        return std::comp_ellint_1(k) - std::ellint_1(k, from(k)) - root;
    });
    const double k = modulus(slope);
    return {std::sqrt(2 * std::sin(slope)) / root,
            1 - 2 / root * (std::comp_ellint_2(k) - std::ellint_2(k, from(k)))};
}

double edge_crack_factor(double ratio) {
    return 1.12 + ratio * (-0.231 + ratio * (10.55 + ratio * (-21.72 + ratio * 30.39)));
}

}  // namespace hibi
