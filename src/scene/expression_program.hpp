#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/units.hpp"

namespace hibi {

/// What an expression is made of, leaves first.
enum class Op {
    constant,
    x,
    y,
    z,
    t,
    either,
    both,
    invert,
    less,
    less_equal,
    greater,
    greater_equal,
    add,
    subtract,
    multiply,
    divide,
    negate,
    power,
    first_function,
    sine = first_function,
    cosine,
    tangent,
    arctangent,
    square_root,
    absolute,
    minimum,
    maximum,
    exponential,
    logarithm,
    hypotenuse,
    step,
    count
};

struct Operator {
    const char* symbol = "";
    int operands = 0;
    int rank = 0;  ///< how closely it binds
    double (*apply)(double a, double b) = nullptr;
};

/// Indexed by Op.
extern const std::array<Operator, static_cast<int>(Op::count)> operators;
inline const Operator& operator_of(Op op) { return operators[static_cast<int>(op)]; }

/// Programs are in postfix order.
struct Instruction {
    Op op = Op::constant;
    double value = 0;       ///< of a constant (SI)
    Dimension dimension{};  ///< of the result
};
using Program = std::vector<Instruction>;

inline constexpr int largest_stack = 512;  ///< operands waiting at once

/// What the parser found out about a text.
struct Parsed {
    Program program;
    Dimension dimension{};
    bool condition = false;
    bool bare_number = false;  ///< one number without a unit, perhaps with a sign
};
struct Names;
Parsed parse_expression(const std::string& text, const Names& names);

}  // namespace hibi
