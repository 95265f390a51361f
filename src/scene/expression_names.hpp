#pragma once
#include <optional>
#include <string>

#include "scene/expression.hpp"

namespace hibi {

inline bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
/// The name that begins at a byte of a text; empty if none does.
std::string name_at(const std::string& text, int begin);

bool is_word(const std::string& name);                          ///< and, or, not
bool is_variable(const Names& names, const std::string& name);  ///< x, y, z, t where they mean something
std::optional<Op> function_named(const std::string& name);

/// Reads one more factor of the unit behind a number, its sign * or / included, and moves `at` behind it;
/// false where none follows. After * a name of the scene goes before a unit; after / the two could be meant
/// alike, and asking is better than guessing. Throws ExpressionError.
bool read_unit_factor(const std::string& text, const Names& names, int& at, Quantity& unit);

}  // namespace hibi
