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
        return {std::pow(10, -3 * thousands), "×" + power_of_ten(3 * thousands)};
    }
    static const char* const prefixes[] = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};
    const int step = std::clamp(thousands, -4, unit == "s" ? 0 : unit == "m" ? 1 : 4);
    return {std::pow(10, -3 * step), prefixes[step + 4] + unit};
}

std::string power_of_ten(int exponent) {
    static const char* const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = "10";
    for (const char c : fmt::format("{}", exponent)) text += c == '-' ? "⁻" : raised[c - '0'];
    return text;
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
    // Steps rising from one that gives far too many ticks. The first plain one (1, 2, 5) that gives few
    // enough is taken, unless one of the next makes ticks of both ends.
    double step = 0, several = 0;  // the first one that gives two ticks or more
    const auto ticks_with = [&](double s) {
        return std::floor(high / s + 1e-9) - std::ceil(low / s - 1e-9) + 1;
    };
    const auto whole = [](double v) { return std::abs(v - std::round(v)) < 1e-6; };
    double power = std::pow(10, std::floor(std::log10((high - low) / (10.0 * most))));
    for (int tries = 0; tries < 20; ++tries, power *= tries % 5 == 0 ? 10 : 1) {
        constexpr double leads[] = {1, 2, 2.5, 4, 5};
        const double lead = leads[tries % 5], candidate = lead * power;
        if (ticks_with(candidate) > most) continue;
        const bool plain = lead != 2.5 && lead != 4;
        const bool ends = whole(low / candidate) && whole(high / candidate);
        if (several == 0 && ticks_with(candidate) >= 2) several = candidate;
        if (ends || (plain && step == 0)) step = candidate;
        if (ends || (step > 0 && candidate > 2.6 * step)) break;
    }
    if (several > 0 && ticks_with(step) < 2) step = several;  // a lone tick is no scale
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        ticks.at.push_back(k * step);
    ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    if (!whole(step * std::pow(10, ticks.decimals))) ++ticks.decimals;  // 2.5
    return ticks;
}

std::vector<double> log_ticks(double low, double high, int most, std::vector<double>* minor) {
    const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
    const int last = static_cast<int>(std::ceil(std::log10(high))) + 1;
    const auto inside = [&](double v) { return v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9); };
    const auto ticks_with = [&](std::initializer_list<int> leads, int decades) {
        std::vector<double> ticks;
        for (int e = first; e <= last; ++e)
            for (const int lead : leads)
                if (e % decades == 0 && inside(lead * std::pow(10, e)))
                    ticks.push_back(lead * std::pow(10, e));
        return ticks;
    };
    std::vector<double> ticks = ticks_with({1, 2, 5}, 1);
    if (ticks.size() < 2) return round_ticks(low, high, most).at;
    for (int decades = 1; static_cast<int>(ticks.size()) > most && decades <= last - first; ++decades)
        ticks = ticks_with({1}, decades);
    if (!minor || high / low > 1e4) return ticks;
    for (const double v : ticks_with({2, 3, 4, 5, 6, 7, 8, 9}, 1))
        if (std::ranges::find(ticks, v) == ticks.end()) minor->push_back(v);
    return ticks;
}

}  // namespace hibi
