#pragma once
#include <array>
#include <optional>
#include <string>

namespace hibi {

/// Powers of the seven SI base units m, kg, s, A, K, mol, cd. Powers may be broken ("MPa m^0.5").
struct Dimension {
    std::array<double, 7> power{};

    bool operator==(const Dimension& other) const;
    bool is_plain() const { return *this == Dimension{}; }  ///< a pure number
};
Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
Dimension pow(const Dimension& a, double exponent);

/// A unit, or a value with a unit: `value` in SI base units.
struct Quantity {
    double value = 0;
    Dimension dimension{};
};

/// A unit named by letters alone, such as "MPa" or "s"; UDUNITS-2 knows the names. Nothing where it knows
/// none, or where the unit is no plain multiple of SI (degrees Celsius, decibels). Thread-safe. Throws
/// std::runtime_error where the unit table of UDUNITS-2 is not installed.
std::optional<Quantity> unit_atom(const std::string& letters);

/// A factor between units without the rounding of the way it was computed: "g/cm^3" is 1000, not
/// 1000.0000000000001.
double tidy_factor(double factor);

/// A unit such as "kg/m^3", "MPa m^0.5", "1/s", "" (a pure number): atoms with powers, multiplied by a space
/// or *, divided by /. Nothing where it is none.
std::optional<Quantity> parse_unit(const std::string& text);

/// The dimension of a unit known to the program, written as in parse_unit. Throws std::logic_error otherwise.
Dimension dimension_of(const std::string& unit);

/// In words with article, for messages: "a pressure"; units of a dimension without a name: "in kg m^-1".
std::string dimension_name(const Dimension& dimension);
/// The usual SI symbol, "Pa", or base units, "kg m^-1"; what parse_unit reads. Empty for a pure number.
std::string si_symbol(const Dimension& dimension);

/// A value for people, with as many significant digits and the prefix that fits: format_si(3.53e7, "N", 3) is
/// "35.3 MN". Units without a customary prefix (kg, rad, m^2, ...) keep theirs; seconds are never kiloseconds
/// and metres never megametres. The number of digits does not change with the value, so that a counter does
/// not jump; `trim` drops trailing zeros ("40 m").
std::string format_si(double value, const std::string& unit, int digits = 3, bool trim = false);

}  // namespace hibi
