#include "model/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/hash.hpp"

namespace hibi {

namespace {

constexpr double pi = std::numbers::pi;

/// Twice the signed area of a polygon (m^2), positive counter-clockwise.
double twice_area(const std::vector<Vec<2>>& corners) {
    double sum = 0;
    for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++)
        sum += corners[last].x() * corners[k].y() - corners[k].x() * corners[last].y();
    return sum;
}

/// Even-odd rule. A point on an edge may fall on either side; lattice points are kept off edges by `fill`.
bool inside_polygon(const std::vector<Vec<2>>& corners, const Vec<2>& X) {
    bool odd = false;
    for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++) {
        const Vec<2>&a = corners[last], &b = corners[k];
        if ((a.y() > X.y()) != (b.y() > X.y()) &&
            X.x() < (b.x() - a.x()) * (X.y() - a.y()) / (b.y() - a.y()) + a.x())
            odd = !odd;
    }
    return odd;
}

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};

/// Where the lattice of a shape is anchored: a corner of a cell.
template <int Dim>
Vec<Dim> lattice_origin(const Shape<Dim>& shape, double spacing) {
    return std::visit(Overloaded{
                          [](const Box<Dim>& s) -> Vec<Dim> { return s.low; },
                          [](const Polygon& s) -> Vec<Dim> { return bounding_box(Shape<Dim>{s}).low; },
                          [&](const Difference<Dim>& s) { return lattice_origin(s.parts.front(), spacing); },
                          [&](const auto& round) -> Vec<Dim> {  // symmetric about the centre
                              const Box<Dim> box = bounding_box(Shape<Dim>{round});
                              const double cells = std::ceil((box.high - box.low).x() / 2 / spacing - 1e-9);
                              return round.centre - Vec<Dim>::Constant(cells * spacing);
                          },
                      },
                      shape.form);
}

}  // namespace

template <int Dim>
bool inside(const Shape<Dim>& shape, const Vec<Dim>& X) {
    return std::visit(Overloaded{
                          [&](const Box<Dim>& s) {
                              return (X.array() >= s.low.array()).all() &&
                                     (X.array() <= s.high.array()).all();
                          },
                          [&](const Disc<Dim>& s) { return (X - s.centre).norm() <= s.radius; },
                          [&](const Ring<Dim>& s) {
                              const double r = (X - s.centre).norm();
                              return r >= s.inner && r <= s.outer;
                          },
                          [&](const Polygon& s) { return inside_polygon(s.corners, X); },
                          [&](const Difference<Dim>& s) {
                              return inside(s.parts.front(), X) &&
                                     std::none_of(s.parts.begin() + 1, s.parts.end(),
                                                  [&](const Shape<Dim>& part) { return inside(part, X); });
                          },
                      },
                      shape.form);
}

template <int Dim>
Box<Dim> bounding_box(const Shape<Dim>& shape) {
    return std::visit(Overloaded{
                          [](const Box<Dim>& s) { return s; },
                          [](const Disc<Dim>& s) {
                              const Vec<Dim> r = Vec<Dim>::Constant(s.radius);
                              return Box<Dim>{s.centre - r, s.centre + r};
                          },
                          [](const Ring<Dim>& s) {
                              const Vec<Dim> r = Vec<Dim>::Constant(s.outer);
                              return Box<Dim>{s.centre - r, s.centre + r};
                          },
                          [](const Polygon& s) {
                              Box<Dim> box{s.corners.front(), s.corners.front()};
                              for (const Vec<2>& c : s.corners) {
                                  box.low = box.low.cwiseMin(c);
                                  box.high = box.high.cwiseMax(c);
                              }
                              return box;
                          },
                          [](const Difference<Dim>& s) { return bounding_box(s.parts.front()); },
                      },
                      shape.form);
}

template <int Dim>
double measure(const Shape<Dim>& shape) {
    static_assert(Dim == 2, "the areas below are plane");
    return std::visit(Overloaded{
                          [](const Box<Dim>& s) { return (s.high - s.low).prod(); },
                          [](const Disc<Dim>& s) { return pi * s.radius * s.radius; },
                          [](const Ring<Dim>& s) { return pi * (s.outer * s.outer - s.inner * s.inner); },
                          [](const Polygon& s) { return std::abs(twice_area(s.corners)) / 2; },
                          [](const Difference<Dim>& s) {
                              // Removed shapes may reach beyond the first, and into each other: the share
                              // of a fine lattice that remains.
                              constexpr int fine = 1000;
                              const Shape<Dim> all{s};
                              const Shape<Dim>& first = s.parts.front();
                              const Box<Dim> box = bounding_box(first);
                              const Vec<Dim> cell = (box.high - box.low) / fine;
                              long whole = 0, rest = 0;
                              for (int row = 0; row < fine; ++row)
                                  for (int column = 0; column < fine; ++column) {
                                      const Vec<Dim> X =
                                          box.low + cell.cwiseProduct(Vec<Dim>(column + 0.5, row + 0.5));
                                      if (!inside(first, X)) continue;
                                      ++whole;
                                      rest += inside(all, X);
                                  }
                              return whole > 0 ? measure(first) * double(rest) / double(whole) : 0.0;
                          },
                      },
                      shape.form);
}

template <int Dim>
std::vector<Vec<Dim>> fill(const Shape<Dim>& shape, double spacing, const Lattice& lattice) {
    static_assert(Dim == 2, "the rows below are plane");
    const Box<Dim> box = bounding_box(shape);
    Vec<Dim> origin = lattice_origin(shape, spacing);
    Vec<Dim> along = Vec<Dim>::UnitX(), up = Vec<Dim>::UnitY();
    // Columns and rows of the cells that meet the bounding box.
    int first_column = 0, first_row = 0;
    int columns = static_cast<int>(std::ceil((box.high.x() - origin.x()) / spacing - 1e-9));
    int rows = static_cast<int>(std::ceil((box.high.y() - origin.y()) / spacing - 1e-9));
    if (lattice.is_turned()) {
        along = {std::cos(lattice.angle), std::sin(lattice.angle)};
        up = {-along.y(), along.x()};
        const Vec<Dim> middle = (box.low + box.high) / 2;
        origin += spacing * ((middle - origin) / spacing).array().round().matrix();
        const double reach = (box.high - box.low).norm() / 2 + (middle - origin).norm();
        rows = columns = static_cast<int>(std::ceil(reach / spacing));
        first_row = first_column = -rows;
    }
    std::vector<Vec<Dim>> points;
    for (int row = first_row; row < rows; ++row) {
        for (int column = first_column; column < columns; ++column) {
            const Vec<Dim> X = lattice.is_turned()
                                   ? Vec<Dim>(origin + spacing * ((column + 0.5) * along + (row + 0.5) * up))
                                   : Vec<Dim>(origin + spacing * Vec<Dim>(column + 0.5, row + 0.5));
            if (!inside(shape, X)) continue;
            points.push_back(X);
            if (lattice.jitter == 0) continue;
            const std::uint64_t cell = std::uint64_t(std::uint32_t(column)) << 32 | std::uint32_t(row);
            const std::uint64_t bits = mix_bits(mix_bits(lattice.seed) ^ cell);
            const Vec<Dim> random(unit_random(bits), unit_random(mix_bits(bits)));
            points.back() += lattice.jitter * spacing * (2 * random - Vec<Dim>::Ones());
        }
    }
    return points;
}

template bool inside<2>(const Shape<2>&, const Vec<2>&);
template Box<2> bounding_box<2>(const Shape<2>&);
template double measure<2>(const Shape<2>&);
template std::vector<Vec<2>> fill<2>(const Shape<2>&, double, const Lattice&);

}  // namespace hibi
