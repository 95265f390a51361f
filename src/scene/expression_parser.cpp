// Longer than 400 lines because the functions of a grammar call each other and are read together.
#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/expression.hpp"
#include "scene/expression_names.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

constexpr int deepest_nesting = 64;  // of parentheses, signs and powers
constexpr int longest_text = 10000;  // bytes

/// Recursive descent; each function appends the program of what it read and returns its type.
class Parser {
 public:
    Parser(const std::string& text, const Names& names) : text_(text), names_(names) {}

    struct Type {
        Dimension dimension{};
        bool condition = false;
        bool constant = false;
        int begin = 0, end = 0;  ///< bytes of the text
    };

    Type parse() {
        if (static_cast<int>(text_.size()) > longest_text)
            throw ExpressionError(0, 1,
                                  fmt::format("an expression of {} characters is too long", text_.size()));
        skip_spaces();
        if (at_end())
            throw ExpressionError(0, std::max(1, static_cast<int>(text_.size())), "nothing is written here");
        const Type type = either();
        if (!at_end()) unexpected();
        return type;
    }

    Program program;
    int numbers = 0, names_used = 0, operators_used = 0;

 private:
    const std::string& text_;
    const Names& names_;
    int at_ = 0, depth_ = 0, last_end_ = 0;

    bool at_end() const { return at_ >= static_cast<int>(text_.size()); }
    char peek(int ahead = 0) const {
        return at_ + ahead < static_cast<int>(text_.size()) ? text_[at_ + ahead] : '\0';
    }
    void skip_spaces() {
        last_end_ = at_;
        while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
    }
    void advance(int bytes) {
        at_ += bytes;
        skip_spaces();
    }
    bool take(const char* symbol) {
        const std::size_t length = std::char_traits<char>::length(symbol);
        if (text_.compare(at_, length, symbol) != 0) return false;
        advance(static_cast<int>(length));
        return true;
    }
    bool take_word(const char* word) {
        if (name_at(text_, at_) != word) return false;
        advance(static_cast<int>(std::char_traits<char>::length(word)));
        return true;
    }

    [[noreturn]] void unexpected() {
        if (at_end()) throw ExpressionError(std::max(0, last_end_ - 1), 1, "the expression ends too early");
        int bytes = std::max(1, static_cast<int>(name_at(text_, at_).size()));
        while ((peek(bytes) & 0xC0) == 0x80) ++bytes;  // a whole character of UTF-8
        const std::string found = text_.substr(at_, bytes);
        std::string hint;
        if (found == ",") hint = "the decimal sign is a point";
        if (found == "%") hint = "write a plain number: 5 % is 0.05";
        if (found == "=") hint = "compare with < <= > >=; positions are never exactly equal";
        if (found == "&" || found == "|" || found == "!") hint = "write and, or, not";
        if (starts_name(found[0])) hint = "put an operator such as * before it";
        throw ExpressionError(at_, bytes, fmt::format("unexpected \"{}\"", found), hint);
    }

    struct Nested {
        explicit Nested(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > deepest_nesting)
                throw ExpressionError(parser_.at_, 1,
                                      fmt::format("nested more than {} deep", deepest_nesting));
        }
        ~Nested() { --parser_.depth_; }
        Nested(const Nested&) = delete;
        Nested& operator=(const Nested&) = delete;
        Parser& parser_;
    };

    void fail(const Type& where, const std::string& message, const std::string& hint = {}) {
        throw ExpressionError(where.begin, std::max(1, where.end - where.begin), message, hint);
    }
    std::string text_of(const Type& type) const { return text_.substr(type.begin, type.end - type.begin); }
    void want_value(const Type& type) {
        if (type.condition) fail(type, fmt::format("\"{}\" is a condition, not a value", text_of(type)));
    }
    void want_condition(const Type& type) {
        if (!type.condition)
            fail(type,
                 fmt::format("\"{}\" is {}, not a condition", text_of(type), dimension_name(type.dimension)),
                 "compare it with something: < <= > >=");
    }
    void want_plain(const Type& type, const std::string& who) {
        want_value(type);
        if (!type.dimension.is_plain())
            fail(type, fmt::format("{} needs a plain number; \"{}\" is {}", who, text_of(type),
                                   dimension_name(type.dimension)));
    }
    bool is_zero(const Type& type) const {
        return type.constant && type.dimension.is_plain() && program.back().value == 0;
    }

    /// Appends an operator whose operands stand at the end of the program, and folds constants.
    Type emit(Op op, const Type& a, const Type* b, const Dimension& dimension, bool condition = false) {
        ++operators_used;
        Type type{dimension, condition, a.constant && (!b || b->constant), a.begin, last_end_};
        Instruction made{op, 0, dimension};
        if (type.constant) {
            const double second = b ? program.back().value : 0;
            if (b) program.pop_back();
            made = {Op::constant, operator_of(op).apply(program.back().value, second), dimension};
            program.pop_back();
            if (!std::isfinite(made.value))
                fail(type, fmt::format("\"{}\" is not a finite number", text_of(type)));
        }
        program.push_back(made);
        return type;
    }

    /// The common dimension of two operands; a constant zero takes the other's.
    Dimension common(const Type& a, bool a_zero, const Type& b, const char* what) {
        want_value(a);
        want_value(b);
        if (a.dimension == b.dimension || is_zero(b)) return a.dimension;
        if (a_zero) return b.dimension;
        std::string hint;
        if (a.dimension.is_plain() || b.dimension.is_plain())
            hint = fmt::format("does \"{}\" lack its unit?", text_of(a.dimension.is_plain() ? a : b));
        throw ExpressionError(
            a.begin, b.end - a.begin,
            fmt::format("{} {} and {}: \"{}\" and \"{}\"", what, dimension_name(a.dimension),
                        dimension_name(b.dimension), text_of(a), text_of(b)),
            hint);
    }

    Type either() {
        Type left = both();
        while (take_word("or")) {
            want_condition(left);
            const Type right = both();
            want_condition(right);
            left = emit(Op::either, left, &right, {}, true);
        }
        return left;
    }
    Type both() {
        Type left = inverted();
        while (take_word("and")) {
            want_condition(left);
            const Type right = inverted();
            want_condition(right);
            left = emit(Op::both, left, &right, {}, true);
        }
        return left;
    }
    Type inverted() {
        const int begin = at_;
        if (!take_word("not")) return comparison();
        const Nested nested(*this);
        Type operand = inverted();
        want_condition(operand);
        operand.begin = begin;
        return emit(Op::invert, operand, nullptr, {}, true);
    }
    std::optional<Op> comparison_sign() {
        if (take("<=")) return Op::less_equal;
        if (take(">=")) return Op::greater_equal;
        if (take("<")) return Op::less;
        if (take(">")) return Op::greater;
        return {};
    }
    Type comparison() {
        const Type left = sum();
        const auto op = comparison_sign();
        if (!op) return left;
        const bool zero = is_zero(left);
        const Type right = sum();
        common(left, zero, right, "cannot compare");
        const int again = at_;
        if (comparison_sign())
            throw ExpressionError(again, 1, "two comparisons in a row",
                                  "write them apart: x > 1 m and x < 2 m");
        return emit(*op, left, &right, {}, true);
    }
    Type sum() {
        Type left = product();
        for (;;) {
            Op op = Op::add;
            if (take("-"))
                op = Op::subtract;
            else if (!take("+"))
                return left;
            const bool zero = is_zero(left);
            const Type right = product();
            const Dimension dimension =
                common(left, zero, right, op == Op::add ? "cannot add" : "cannot subtract");
            left = emit(op, left, &right, dimension);
        }
    }
    Type product() {
        Type left = sign();
        for (;;) {
            Op op = Op::multiply;
            if (take("/"))
                op = Op::divide;
            else if (!take("*"))
                return left;
            want_value(left);
            const Type right = sign();
            want_value(right);
            left =
                emit(op, left, &right,
                     op == Op::divide ? left.dimension / right.dimension : left.dimension * right.dimension);
        }
    }
    Type sign() {
        const int begin = at_;
        const bool minus = peek() == '-';
        if (!minus && peek() != '+') return power();
        const Nested nested(*this);
        advance(1);
        Type operand = sign();
        want_value(operand);
        operand.begin = begin;
        if (!minus) return operand;
        const int before = operators_used;
        const Type result = emit(Op::negate, operand, nullptr, operand.dimension);
        operators_used = before;  // a sign belongs to a bare number
        return result;
    }
    Type power() {
        const Type base = primary();
        if (!take("^")) return base;
        const Nested nested(*this);
        want_value(base);
        const Type exponent = sign();
        want_plain(exponent, "an exponent");
        if (base.dimension.is_plain()) return emit(Op::power, base, &exponent, {});
        if (!exponent.constant) fail(exponent, "the exponent of a quantity with a unit must be constant");
        const double p = program.back().value;
        if (std::abs(p) > 100) fail(exponent, "an exponent beyond 100");
        return emit(Op::power, base, &exponent, pow(base.dimension, p));
    }

    Type primary() {
        if (at_end()) unexpected();
        const int begin = at_;
        if (std::isdigit(static_cast<unsigned char>(peek())) ||
            (peek() == '.' && std::isdigit(static_cast<unsigned char>(peek(1)))))
            return number();
        if (peek() == '(') {
            const Nested nested(*this);
            advance(1);
            ++operators_used;
            Type inner = either();
            close(begin);
            inner.begin = begin;
            inner.end = last_end_;
            return inner;
        }
        const std::string name = name_at(text_, at_);
        if (name.empty() || is_word(name)) unexpected();
        advance(static_cast<int>(name.size()));
        if (const auto op = function_named(name)) return call(*op, begin);
        return variable(name, begin);
    }

    Type number() {
        const int begin = at_;
        double value = 0;
        const char* first = text_.data() + at_;
        const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), value);
        const int digits = static_cast<int>(end - first);
        if (error != std::errc{} || !std::isfinite(value))
            throw ExpressionError(
                begin, std::max(1, digits),
                fmt::format("\"{}\" is too large or too small", text_.substr(begin, digits)));
        advance(digits);
        Quantity unit{1, {}};
        while (read_unit_factor(text_, names_, at_, unit)) skip_spaces();
        value *= tidy_factor(unit.value);
        ++numbers;
        if (last_end_ - begin > digits) ++names_used;  // has a unit
        Type type{unit.dimension, false, true, begin, last_end_};
        if (!std::isfinite(value)) fail(type, fmt::format("\"{}\" is not a finite number", text_of(type)));
        program.push_back({Op::constant, value, unit.dimension});
        return type;
    }

    Type variable(const std::string& name, int begin) {
        ++names_used;
        Type type{{}, false, false, begin, last_end_};
        const auto param = names_.params.find(name);
        if (param != names_.params.end() || name == "pi") {
            type.constant = true;
            const Quantity quantity = name == "pi" ? Quantity{std::numbers::pi, {}} : param->second;
            type.dimension = quantity.dimension;
            program.push_back({Op::constant, quantity.value, quantity.dimension});
            return type;
        }
        const bool is_place = name == "x" || name == "y" || name == "z";
        if (is_variable(names_, name)) {
            type.dimension.power[name == "t" ? 2 : 0] = 1;
            program.push_back({name == "t"   ? Op::t
                               : name == "x" ? Op::x
                               : name == "y" ? Op::y
                                             : Op::z,
                               0, type.dimension});
            return type;
        }
        if (is_place)
            fail(type, fmt::format("\"{}\" cannot stand here: this value is the same everywhere", name));
        if (name == "t") fail(type, "\"t\" cannot stand here: this value is the same at all times");
        std::vector<std::string> known;
        for (const auto& [param_name, quantity] : names_.params) known.push_back(param_name);
        const std::string letters = name.substr(0, name.find_first_of("0123456789"));
        if (letters != name && unit_atom(letters))
            fail(type, fmt::format("unknown name \"{}\"", name), "write powers with ^: m^3");
        std::string hint = unit_atom(name) ? fmt::format("a unit needs a number before it: 1 {}", name)
                                           : "names come from [params]";
        if (const auto near = nearest(name, known))
            hint = fmt::format("did you mean \"{}\"?", *near);
        else if (!known.empty() && !unit_atom(name))
            hint += ": " + list_of(known);
        fail(type, fmt::format("unknown name \"{}\"", name), hint);
        return type;
    }

    Type call(Op op, int begin) {
        ++names_used;
        const Nested nested(*this);
        const std::string name = operator_of(op).symbol;
        const int wanted = operator_of(op).operands;
        const bool or_more = op == Op::minimum || op == Op::maximum;
        if (!take("("))
            throw ExpressionError(begin, last_end_ - begin, fmt::format("{} needs ( behind it", name));
        Type result = either();
        want_value(result);
        int count = 1;
        while (take(",")) {
            if (++count > wanted && !or_more) break;
            const bool zero = is_zero(result);
            const Type next = either();
            const Dimension dimension = common(result, zero, next, "cannot mix");
            result = emit(op, result, &next, op == Op::arctangent ? Dimension{} : dimension);
        }
        if (count < wanted || (count > wanted && !or_more))
            throw ExpressionError(begin, at_ - begin,
                                  fmt::format("{} takes {}", name,
                                              wanted == 1 ? "one value"
                                              : or_more   ? "two or more values"
                                                          : "two values"));
        close(begin);
        if (wanted == 1) {
            Dimension dimension{};
            if (op == Op::square_root)
                dimension = pow(result.dimension, 0.5);
            else if (op == Op::absolute)
                dimension = result.dimension;
            else if (op != Op::step)
                want_plain(result, name);
            result.begin = begin;
            result = emit(op, result, nullptr, dimension);
        }
        result.begin = begin;
        result.end = last_end_;
        return result;
    }

    void close(int begin) {
        if (take(")")) return;
        if (!at_end()) unexpected();
        throw ExpressionError(begin, 1, "this parenthesis is never closed");
    }
};

}  // namespace

Parsed parse_expression(const std::string& text, const Names& names) {
    Parser parser(text, names);
    const auto type = parser.parse();
    int waiting = 0;
    for (const Instruction& instruction : parser.program) {
        waiting += 1 - operator_of(instruction.op).operands;
        if (waiting > largest_stack) throw ExpressionError(0, 1, "the expression is too deep");
    }
    const bool bare = parser.numbers == 1 && parser.names_used == 0 && parser.operators_used == 0;
    return {std::move(parser.program), type.dimension, type.condition, bare};
}

}  // namespace hibi
