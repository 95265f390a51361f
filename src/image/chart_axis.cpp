#include "image/chart_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hibi {

bool fits_on(const ChartAxis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

double axis_share(const std::array<double, 2>& range, bool logarithmic, double value) {
    return logarithmic ? std::log(value / range[0]) / std::log(range[1] / range[0])
                       : (value - range[0]) / (range[1] - range[0]);
}

namespace {

std::array<double, 2> range_of(const ChartAxis& axis, const std::vector<double>& values, double beyond) {
    if (axis.range) return *axis.range;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : values)
        if (fits_on(axis, v)) low = std::min(low, v), high = std::max(high, v);
    if (!(low <= high)) return axis.logarithmic ? std::array{1.0, 10.0} : std::array{0.0, 1.0};
    if (axis.logarithmic) {
        const double factor = std::max(std::pow(high / low, beyond), 1.1);
        return {low / factor, high * factor};
    }
    if (axis.from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
    if (low == high)
        return low == 0 ? std::array{0.0, 1.0}
                        : std::array{low - 0.1 * std::abs(low), low + 0.1 * std::abs(low)};
    const double more = beyond * (high - low);
    return {axis.from_zero && low == 0 ? 0 : low - more, axis.from_zero && high == 0 ? 0 : high + more};
}

/// Three significant digits, or all before the point.
std::string short_number(double v) { return v < 1000 ? fmt::format("{:.3g}", v) : fmt::format("{:.0f}", v); }

}  // namespace

ChartScale::ChartScale(const ChartAxis& axis, const std::vector<double>& values, double beyond)
    : range_(range_of(axis, values, beyond)), logarithmic_(axis.logarithmic) {
    // The largest value chooses the prefix, not what is beyond it.
    double largest = 0;
    for (const double v : values)
        if (!axis.range && fits_on(axis, v)) largest = std::max(largest, std::abs(v));
    if (largest == 0) largest = std::max(std::abs(range_[0]), std::abs(range_[1]));
    scale_ = scale_for(largest, axis.unit);
    powers_ = logarithmic_ && range_[1] / range_[0] > 1e5;
    if (powers_) scale_ = {1, axis.unit};
    title_ = with_unit(axis.title, scale_);
}

std::vector<ChartScale::Number> ChartScale::ticks(int most) const {
    std::vector<Number> numbers;
    if (!logarithmic_) {
        const Ticks ticks = round_ticks(range_[0] * scale_.factor, range_[1] * scale_.factor, most);
        for (const double v : ticks.at) numbers.push_back({v / scale_.factor, decimal(v, ticks.decimals)});
        return numbers;
    }
    std::vector<double> minor;
    // The written numbers have to be round, also in percent or thousands.
    for (const double v : log_ticks(range_[0] * scale_.factor, range_[1] * scale_.factor, most, &minor)) {
        const double exponent = std::log10(v);
        const bool power = powers_ && std::abs(exponent - std::round(exponent)) < 1e-6;
        if (powers_ && !power)
            minor.push_back(v);
        else
            numbers.push_back({v / scale_.factor, power
                                                      ? power_of_ten(static_cast<int>(std::lround(exponent)))
                                                      : short_number(v)});
    }
    for (const double v : minor) numbers.push_back({v / scale_.factor, ""});
    return numbers;
}

std::vector<ChartScale::Number> ChartScale::few_values(std::vector<double> values) const {
    std::erase_if(values, [&](double v) { return !(v >= range_[0] && v <= range_[1]); });
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (!logarithmic_ || powers_ || values.size() > 6) return {};
    std::vector<Number> numbers;
    for (const double v : values) numbers.push_back({v, short_number(v * scale_.factor)});
    return numbers;
}

}  // namespace hibi
