#pragma once
#include <cmath>
#include <experimental/simd>

namespace hibi {

// Included by the loops that are compiled for several processors: what is here is always inlined, so that no
// processor gets another one's code.

/// condition ? yes : no, for each number.
template <class Number, class Condition>
[[gnu::always_inline]] inline Number choose(const Condition& condition, const Number& yes, const Number& no) {
    Number chosen = no;
    std::experimental::where(condition, chosen) = yes;
    return chosen;
}

/// Polar rotation R of the deformation A of a particle in the plane, and its dilatation D = tr(R^T A) - m.
/// From the trace and the antisymmetric part A21 - A12 of A - M, with M the value of A at rest and m = tr M:
/// R turns the axis onto Z = (m + trace, twist), and q = |Z| = D + m.
/// Without cancellation at small strain and with one division: q - m = (q^2 - m^2) / (q + m), and along - q
/// likewise unless along < 0.
/// Number is double, or one number for each of several particles.
template <class Number>
struct PlaneRotation {
    Number cosine_less_one, sine;  ///< of R - I, so that a small rotation keeps its digits
    Number dilatation;             ///< D [-]

    [[gnu::always_inline]] PlaneRotation(const Number& trace, const Number& twist, const Number& m) {
        using std::sqrt;  // of one number; that of several is found by their type
        const Number along = m + trace;
        const Number q = sqrt(along * along + twist * twist);
        // No bonds left, or exactly turned inside out: any rotation is stationary.
        const auto none = q == 0, inverted = along < 0;
        const Number one(1.0), zero(0.0);
        const Number safe_q = choose(none, one, q), sum = choose(inverted || none, one, q + along);
        const Number high = safe_q + m;
        const Number reciprocal = 1.0 / (safe_q * sum * high);
        sine = twist * (reciprocal * (sum * high));
        cosine_less_one = choose(inverted, (along - q) * (reciprocal * (sum * high)),
                                 -twist * sine * (reciprocal * (safe_q * high)));
        dilatation = (trace * (2.0 * m + trace) + twist * twist) * (reciprocal * (safe_q * sum));
        cosine_less_one = choose(none, zero, cosine_less_one);
        dilatation = choose(none, zero, dilatation);
    }
};

}  // namespace hibi
