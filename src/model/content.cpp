// Areas and centroids are plane by nature.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/overloaded.hpp"
#include "model/shape.hpp"

namespace hibi {

namespace {

constexpr double pi = std::numbers::pi;

/// Heights at which a side of the shape begins or ends.
void add_heights(const Shape<2>& shape, std::vector<double>& heights) {
    std::visit(Overloaded{
                   [&](const Polygon& s) {
                       for (const Vec<2>& c : s.corners) heights.push_back(c.y());
                   },
                   [&](const Ring<2>& s) {
                       for (const double r : {-s.outer, -s.inner, s.inner, s.outer})
                           heights.push_back(s.centre.y() + r);
                   },
                   [&](const Difference<2>& s) {
                       for (const Shape<2>& part : s.parts) add_heights(part, heights);
                   },
                   [&](const auto& s) {
                       const Box<2> box = bounding_box(Shape<2>{s});
                       heights.insert(heights.end(), {box.low.y(), box.high.y()});
                   },
               },
               shape.form);
}

/// Sums over horizontal lines, whose parts within the shape are exact. Between two heights where a side
/// begins or ends the lines crowd towards both, as the widths of round sides ask for.
Content<2> content_by_lines(const Shape<2>& shape) {
    const Box<2> box = bounding_box(shape);
    std::vector<double> heights;
    add_heights(shape, heights);
    std::erase_if(heights, [&](double y) { return y < box.low.y() || y > box.high.y(); });
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    const int lines = std::max(20, 20000 / static_cast<int>(heights.size()));
    const double width = (box.high - box.low).x();
    Content<2> sum;
    for (std::size_t k = 1; k < heights.size(); ++k) {
        const double middle = (heights[k - 1] + heights[k]) / 2, half = (heights[k] - heights[k - 1]) / 2;
        for (int line = 0; line < lines; ++line) {
            const auto height = [&](double at) { return half * std::sin(pi * (at / lines - 0.5)); };
            const double y = middle + height(line + 0.5);
            const double thickness = height(line + 1) - height(line);
            const Vec<2> left(box.low.x() - width / 2, y), right(box.high.x() + width / 2, y);
            for (const Span& span : spans(shape, left, right)) {
                const double begin = span.begin * 2 * width, end = span.end * 2 * width;
                const double part = (end - begin) * thickness;
                sum.measure += part;
                // Relative to the box, so that nothing is lost far from the origin.
                sum.centroid += part * Vec<2>((begin + end) / 2 - width / 2, y - box.low.y());
            }
        }
    }
    sum.centroid = box.low + (sum.measure > 0 ? Vec<2>(sum.centroid / sum.measure) : Vec<2>::Zero());
    return sum;
}

}  // namespace

template <>
Content<2> content(const Shape<2>& shape) {
    return std::visit(Overloaded{
                          [](const Box<2>& s) {
                              return Content<2>{(s.high - s.low).prod(), (s.low + s.high) / 2};
                          },
                          [](const Disc<2>& s) {
                              return Content<2>{pi * s.radius * s.radius, s.centre};
                          },
                          [](const Ring<2>& s) {
                              return Content<2>{pi * (s.outer * s.outer - s.inner * s.inner), s.centre};
                          },
                          [](const Polygon& s) {
                              return Content<2>{area(s), centroid(s)};
                          },
                          [&](const Difference<2>&) { return content_by_lines(shape); },
                      },
                      shape.form);
}

}  // namespace hibi
