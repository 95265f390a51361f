#include "image/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hibi {

Scale scale_for(double largest, const std::string& unit) {
    largest = std::abs(largest);
    if (!(largest > 0) || !std::isfinite(largest)) return {1, unit};
    // The small addition keeps 999.9999999 from asking for another prefix than 1000.
    const int thousands = static_cast<int>(std::floor(std::log10(largest) / 3 + 1e-9));
    if (unit.empty()) {
        if (largest >= 0.5 && largest < 1e5) return {1, ""};
        if (largest >= 1e-4 && largest < 0.5) return {100, "%"};
        std::string power;
        static const char* const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        for (const char c : fmt::format("{}", 3 * thousands)) power += c == '-' ? "⁻" : raised[c - '0'];
        return {std::pow(10, -3 * thousands), "×10" + power};
    }
    static const char* const prefixes[] = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};
    const int step = std::clamp(thousands, -4, unit == "s" ? 0 : unit == "m" ? 1 : 4);
    return {std::pow(10, -3 * step), prefixes[step + 4] + unit};
}

std::string with_unit(const std::string& title, const Scale& scale) {
    return scale.unit.empty() ? title : fmt::format("{} ({})", title, scale.unit);
}

std::string decimal(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
    const bool zero = text.find_first_of("123456789") == std::string::npos;
    return value < 0 && !zero ? "−" + text : text;
}

double round_below(double limit) {
    const double power = std::pow(10, std::floor(std::log10(limit) + 1e-9));
    const double lead = limit / power * (1 + 1e-9);
    return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

Ticks round_ticks(double low, double high, int most) {
    Ticks ticks;
    if (!(high > low)) return {{low}, 0};
    // The first round step that gives few enough: begin well below, and go up 1, 2, 5, 10, ...
    double step = round_below((high - low) / (2.0 * most));
    const auto first = [&] { return std::ceil(low / step - 1e-9); };
    const auto last = [&] { return std::floor(high / step + 1e-9); };
    while (last() - first() + 1 > most) step = round_below(2.5 * step);
    for (double k = first(); k <= last(); ++k) ticks.at.push_back(k * step);
    ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    return ticks;
}

}  // namespace hibi
