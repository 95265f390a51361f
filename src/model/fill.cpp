#include "model/fill.hpp"

#include <cmath>

#include "base/hash.hpp"
#include "base/overloaded.hpp"

namespace hibi {

namespace {

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
std::vector<Vec<Dim>> fill(const Shape<Dim>& shape, double spacing, const Lattice& lattice) {
    static_assert(Dim == 2, "the rows below are plane");
    const double slack = slack_per_spacing * spacing;
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
            if (!inside(shape, X, slack)) continue;
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

template std::vector<Vec<2>> fill<2>(const Shape<2>&, double, const Lattice&);

}  // namespace hibi
