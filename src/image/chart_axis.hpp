#pragma once
#include <array>
#include <string>
#include <vector>

#include "image/axis.hpp"
#include "image/chart.hpp"

namespace hibi {

/// Can the value be shown on such an axis?
bool fits_on(const ChartAxis& axis, double value);

/// Where on an axis from range[0] to range[1] the value is: 0 at the lower end, 1 at the upper.
double axis_share(const std::array<double, 2>& range, bool logarithmic, double value);

/// What an axis covers, and how its numbers are written.
class ChartScale {
 public:
    /// Reaches a share of `beyond` further than the values.
    ChartScale(const ChartAxis& axis, const std::vector<double>& values, double beyond);

    double share(double value) const { return axis_share(range_, logarithmic_, value); }
    const std::array<double, 2>& range() const { return range_; }  ///< SI
    const std::string& title() const { return title_; }
    bool logarithmic() const { return logarithmic_; }

    struct Number {
        double value = 0;    ///< SI
        std::string text{};  ///< empty: between those that have one
    };
    std::vector<Number> ticks(int most) const;
    /// The values themselves where the axis is logarithmic and they are no more than six, else nothing:
    /// spacings of a study, say, are better read than round numbers between them.
    std::vector<Number> few_values(std::vector<double> values) const;

 private:
    std::array<double, 2> range_;
    bool logarithmic_;
    bool powers_ = false;  ///< numbers are written as powers of ten
    Scale scale_;
    std::string title_;
};

}  // namespace hibi
