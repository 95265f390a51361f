#include "scene/expression_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace hibi {

std::string name_at(const std::string& text, int begin) {
    const int size = static_cast<int>(text.size());
    int end = begin;
    if (begin < size && starts_name(text[begin]))
        while (end < size && (starts_name(text[end]) || std::isdigit(static_cast<unsigned char>(text[end]))))
            ++end;
    return text.substr(begin, end - begin);
}

bool is_word(const std::string& name) { return name == "and" || name == "or" || name == "not"; }

bool is_variable(const Names& names, const std::string& name) {
    return (names.space && (name == "x" || name == "y" || name == "z")) || (names.time && name == "t");
}

std::optional<Op> function_named(const std::string& name) {
    for (int op = static_cast<int>(Op::first_function); op < static_cast<int>(Op::count); ++op)
        if (name == operators[op].symbol) return static_cast<Op>(op);
    return {};
}

bool is_reserved_name(const std::string& name) {
    return function_named(name) || is_word(name) || name == "pi" || name == "x" || name == "y" ||
           name == "z" || name == "t";
}

namespace {

int skip_spaces(const std::string& text, int at) {
    while (at < static_cast<int>(text.size()) && (text[at] == ' ' || text[at] == '\t')) ++at;
    return at;
}
char char_at(const std::string& text, int at) { return at < static_cast<int>(text.size()) ? text[at] : '\0'; }

/// Reads "^2", "^-0.5" if it stands at `at`; 1 otherwise.
double read_power(const std::string& text, int& at) {
    const int caret = skip_spaces(text, at);
    if (char_at(text, caret) != '^') return 1;
    int begin = skip_spaces(text, caret + 1);
    const bool minus = char_at(text, begin) == '-';
    if (minus || char_at(text, begin) == '+') ++begin;
    double power = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + std::min(begin, static_cast<int>(text.size())),
                                              last, power, std::chars_format::fixed);
    if (error != std::errc{} || !(power >= 0 && power <= 100))
        throw ExpressionError(caret, 1, "a unit's power must be a number", "for example m^0.5");
    at = static_cast<int>(end - text.data());
    return minus ? -power : power;
}

}  // namespace

bool read_unit_factor(const std::string& text, const Names& names, int& at, Quantity& unit) {
    const char sign = char_at(text, at) == '*' || char_at(text, at) == '/' ? text[at] : ' ';
    const int begin = sign == ' ' ? at : skip_spaces(text, at + 1);
    std::string name = name_at(text, begin);
    int end = begin + static_cast<int>(name.size());
    // The micro sign, and the Greek letter that looks like it.
    if (text.compare(begin, 2, "µ") == 0 || text.compare(begin, 2, "μ") == 0) {
        name = name_at(text, begin + 2).insert(0, 1, 'u');
        end = begin + static_cast<int>(name.size()) + 1;
    }
    if (name.empty() || is_word(name)) return false;
    const auto atom = unit_atom(name);
    const bool param = names.params.count(name) > 0, variable = is_variable(names, name);
    if (sign != ' ') {
        if (function_named(name) && char_at(text, skip_spaces(text, end)) == '(') return false;
        if (sign == '*' && (param || variable)) return false;
        if (variable && unit.dimension.is_plain()) return false;
        if (atom && (param || variable))
            throw ExpressionError(begin, end - begin,
                                  fmt::format("\"{}\" is a unit and a name of this scene alike", name),
                                  fmt::format("write /({0}) for the name, or {0}^-1 for the unit", name));
        if (param || !atom || name == "pi") return false;
    }
    if (!atom) {
        std::string hint = "capitals matter: m, mm, s, ms, kg, N, kN, MN, Pa, MPa, GPa, J";
        if (param || variable || name == "pi")
            hint = fmt::format("to multiply, write * {}", name);
        else if (name.find_first_of("0123456789") != std::string::npos)
            hint = "write powers with ^: m^3";
        throw ExpressionError(begin, end - begin, fmt::format("unknown unit \"{}\"", name), hint);
    }
    at = end;
    const double power = (sign == '/' ? -1 : 1) * read_power(text, at);
    unit.value *= std::pow(atom->value, power);
    unit.dimension = unit.dimension * pow(atom->dimension, power);
    return true;
}

}  // namespace hibi
