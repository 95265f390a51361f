#pragma once
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/field.hpp"
#include "base/units.hpp"
#include "scene/expression_program.hpp"

namespace hibi {

/// A mistake in an expression: which bytes of it, and perhaps a way out.
struct ExpressionError : std::runtime_error {
    ExpressionError(int at, int bytes, const std::string& message, std::string way_out = {})
        : std::runtime_error(message), offset(at), length(bytes), hint(std::move(way_out)) {}
    int offset = 0, length = 1;
    std::string hint;
};

/// What an expression may speak of: parameters, and where a value may vary, x y z (m) and t (s).
struct Names {
    std::map<std::string, Quantity> params{};
    bool space = false, time = false;
};

/// True for names that mean something in every expression (functions, pi, x, and ...) and so cannot be
/// parameters.
bool is_reserved_name(const std::string& name);

/// A formula over quantities. Dimensions are checked when it is parsed, and never again.
///
///     condition  = sums compared by < <= > >=, joined by and, or, not
///     sum        = products joined by + -        product = powers joined by * /
///     power      = primary ^ power               primary = number [unit] | name | function(...) | (...)
///
/// Letters right behind a number are its unit, and bind closer than any operator: "2 m^2" is an area, "1/2 m"
/// is 1/(2 m). A constant 0 has every dimension.
class Expression {
 public:
    /// Throws ExpressionError. A result that is not finite is an error where it is constant.
    Expression(const std::string& text, const Names& names);

    bool is_condition() const { return condition_; }
    const Dimension& dimension() const { return dimension_; }
    /// A single number without unit, perhaps with a sign: what a scene takes as SI.
    bool is_bare_number() const { return bare_number_; }
    bool is_constant() const { return !in_space_ && !in_time_; }
    double operator()(const Vec3& X, double t) const;
    /// Of a condition: is it met at X? What is compared counts as equal where a move of X by `slack` (m)
    /// along an axis would turn the comparison: then <= and >= hold, < and > do not, whatever the rounding.
    bool holds(const Vec3& X, double slack) const;
    /// The value in SI units as a field; its text is text().
    Field field() const;
    /// The same formula with every constant part, parameters included, as one number in SI units.
    std::string text() const;

 private:
    std::shared_ptr<const Program> program_;
    Dimension dimension_{};
    bool condition_ = false, bare_number_ = false, in_space_ = false, in_time_ = false;
};

}  // namespace hibi
