#pragma once
#include <string>
#include <vector>

namespace hibi {

/// How the numbers of one axis are written: one prefix and one number of decimals for all of them, over a
/// whole run, so that text neither jumps nor repeats units.
struct Scale {
    double factor = 1;  ///< written number = value * factor
    std::string unit;   ///< behind the number: "MN", "%", "×10⁻⁶", or ""
};
/// The prefix that suits a largest magnitude. Seconds never become kiloseconds. Plain numbers (unit "") below
/// 0.5 are given in percent, very small ones with a power of ten.
Scale scale_for(double largest, const std::string& unit);

/// "10⁻⁶"
std::string power_of_ten(int exponent);

/// "title (unit)", or the title alone.
std::string with_unit(const std::string& title, const Scale& scale);

/// The value with that many decimals, a true minus sign, and never "-0".
std::string decimal(double value, int decimals);

/// Round numbers (1, 2 or 5 times a power of ten apart) inside [low, high], at most `most` (and at least
/// one).
struct Ticks {
    std::vector<double> at;
    int decimals = 0;  ///< needed to tell them apart
};
Ticks round_ticks(double low, double high, int most);

/// The same on a logarithmic axis, 0 < low < high: powers of ten and, where there is room, 2 and 5 times
/// them; ticks evenly apart in number where these are fewer than two. `minor`, if given, takes the multiples
/// of powers of ten (2, 3, ... 9 times them) that are none, over at most four decades.
std::vector<double> log_ticks(double low, double high, int most, std::vector<double>* minor = nullptr);

/// The largest 1, 2 or 5 times a power of ten that is not above the limit (> 0).
double round_below(double limit);

}  // namespace hibi
