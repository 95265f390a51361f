#include "scene/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hibi {

// clang-format off
const std::array<Operator, static_cast<int>(Op::count)> operators{{
    {"", 0, 11, nullptr},
    {"x", 0, 11, nullptr},
    {"y", 0, 11, nullptr},
    {"z", 0, 11, nullptr},
    {"t", 0, 11, nullptr},
    {" or ", 2, 1, [](double a, double b) -> double { return a != 0 || b != 0; }},
    {" and ", 2, 2, [](double a, double b) -> double { return a != 0 && b != 0; }},
    {"not ", 1, 3, [](double a, double) -> double { return a == 0; }},
    {" < ", 2, 4, [](double a, double b) -> double { return a < b; }},
    {" <= ", 2, 4, [](double a, double b) -> double { return a <= b; }},
    {" > ", 2, 4, [](double a, double b) -> double { return a > b; }},
    {" >= ", 2, 4, [](double a, double b) -> double { return a >= b; }},
    {" + ", 2, 5, [](double a, double b) { return a + b; }},
    {" - ", 2, 5, [](double a, double b) { return a - b; }},
    {"*", 2, 7, [](double a, double b) { return a * b; }},
    {"/", 2, 7, [](double a, double b) { return a / b; }},
    {"-", 1, 8, [](double a, double) { return -a; }},
    {"^", 2, 9, [](double a, double b) { return std::pow(a, b); }},
    {"sin", 1, 11, [](double a, double) { return std::sin(a); }},
    {"cos", 1, 11, [](double a, double) { return std::cos(a); }},
    {"tan", 1, 11, [](double a, double) { return std::tan(a); }},
    {"atan2", 2, 11, [](double a, double b) { return std::atan2(a, b); }},
    {"sqrt", 1, 11, [](double a, double) { return std::sqrt(a); }},
    {"abs", 1, 11, [](double a, double) { return std::abs(a); }},
    {"min", 2, 11, [](double a, double b) { return std::min(a, b); }},
    {"max", 2, 11, [](double a, double b) { return std::max(a, b); }},
    {"exp", 1, 11, [](double a, double) { return std::exp(a); }},
    {"log", 1, 11, [](double a, double) { return std::log(a); }},
    {"hypot", 2, 11, [](double a, double b) { return std::hypot(a, b); }},
    {"step", 1, 11, [](double a, double) -> double { return a >= 0; }},
}};
// clang-format on

namespace {

double run(const Program& program, const Vec3& X, double t) {
    std::array<double, largest_stack> stack;
    int top = -1;
    for (const Instruction& instruction : program) {
        const Operator& o = operator_of(instruction.op);
        switch (o.operands) {
            case 0:
                stack[++top] = instruction.op == Op::constant ? instruction.value
                               : instruction.op == Op::t      ? t
                                                              : X[static_cast<int>(instruction.op) - 1];
                break;
            case 1:
                stack[top] = o.apply(stack[top], 0);
                break;
            default:
                --top;
                stack[top] = o.apply(stack[top], stack[top + 1]);
        }
    }
    return stack[0];
}

/// A point and its neighbours along the axes.
constexpr int places = 7;
using Values = std::array<double, places>;

/// As run, at all places at once. A comparison has one answer for all of them: `<=` and `>=` hold where they
/// do at any of them, `<` and `>` where they do at all.
Values run(const Program& program, const std::array<Vec3, places>& X) {
    std::array<Values, largest_stack> stack;
    int top = -1;
    for (const Instruction& instruction : program) {
        const Operator& o = operator_of(instruction.op);
        if (o.operands == 0) {
            Values& values = stack[++top];
            for (int k = 0; k < places; ++k)
                values[k] = instruction.op == Op::constant ? instruction.value
                            : instruction.op == Op::t      ? 0
                                                           : X[k][static_cast<int>(instruction.op) - 1];
            continue;
        }
        if (o.operands == 2) --top;
        Values& values = stack[top];
        for (int k = 0; k < places; ++k)
            values[k] = o.apply(values[k], o.operands == 2 ? stack[top + 1][k] : 0);
        if (instruction.op == Op::less_equal || instruction.op == Op::greater_equal)
            values.fill(*std::max_element(values.begin(), values.end()));
        if (instruction.op == Op::less || instruction.op == Op::greater)
            values.fill(*std::min_element(values.begin(), values.end()));
    }
    return stack[0];
}

/// A unit would run into what follows, so it stands in parentheses within products; and so does a sign.
int rank_of_constant(const Instruction& constant) {
    return !constant.dimension.is_plain() ? 6 : std::signbit(constant.value) ? 8 : 11;
}

std::string constant_text(const Instruction& constant) {
    std::string unit = si_symbol(constant.dimension);
    if (unit.starts_with("1/")) unit = unit.substr(2) + "^-1";
    return fmt::format("{}{}{}", constant.value, unit.empty() ? "" : " ", unit);
}

}  // namespace

Expression::Expression(const std::string& text, const Names& names) {
    Parsed parsed = parse_expression(text, names);
    dimension_ = parsed.dimension;
    condition_ = parsed.condition;
    bare_number_ = parsed.bare_number;
    for (const Instruction& instruction : parsed.program) {
        in_space_ |= instruction.op == Op::x || instruction.op == Op::y || instruction.op == Op::z;
        in_time_ |= instruction.op == Op::t;
    }
    program_ = std::make_shared<const Program>(std::move(parsed.program));
}

double Expression::operator()(const Vec3& X, double t) const { return run(*program_, X, t); }

bool Expression::holds(const Vec3& X, double slack) const {
    std::array<Vec3, places> around;
    around.fill(X);
    for (int axis = 0; axis < 3; ++axis) {
        around[1 + 2 * axis][axis] -= slack;
        around[2 + 2 * axis][axis] += slack;
    }
    return run(*program_, around)[0] != 0;
}

Field Expression::field() const {
    if (is_constant()) return Field(run(*program_, Vec3::Zero(), 0));
    return Field([program = program_](const Vec3& X, double t) { return run(*program, X, t); }, in_space_,
                 in_time_, text());
}

std::string Expression::text() const {
    struct Part {
        std::string text;
        int rank = 0;
    };
    const auto within = [](const Part& part, int least) {
        return part.rank < least ? "(" + part.text + ")" : part.text;
    };
    std::vector<Part> parts;
    for (const Instruction& instruction : *program_) {
        const Operator& o = operator_of(instruction.op);
        if (instruction.op == Op::constant) {
            parts.push_back({constant_text(instruction), rank_of_constant(instruction)});
            continue;
        }
        if (o.operands == 0) {
            parts.push_back({o.symbol, o.rank});
            continue;
        }
        Part second;
        if (o.operands == 2) {
            second = std::move(parts.back());
            parts.pop_back();
        }
        Part& part = parts.back();
        if (instruction.op >= Op::first_function)
            part.text =
                fmt::format("{}({}{}{})", o.symbol, part.text, o.operands == 2 ? ", " : "", second.text);
        else if (o.operands == 1)
            part.text = o.symbol + within(part, o.rank);
        else if (instruction.op == Op::power)  // binds from the right, and its exponent may carry a sign
            part.text = within(part, o.rank + 1) + o.symbol + within(second, o.rank - 1);
        else
            part.text = within(part, o.rank) + o.symbol + within(second, o.rank + 1);
        part.rank = o.rank;
    }
    return parts.back().text;
}

}  // namespace hibi
