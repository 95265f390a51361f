#include "model/shape.hpp"

#include <algorithm>
#include <cmath>

#include "base/overloaded.hpp"

namespace hibi {

namespace {

/// The part of the segment within a ball.
template <int Dim>
Spans ball_spans(const Vec<Dim>& centre, double radius, const Vec<Dim>& p, const Vec<Dim>& q) {
    const Vec<Dim> along = q - p, from = p - centre;
    const double a = along.squaredNorm(), b = from.dot(along);
    const double nearest = (from - b / a * along).squaredNorm();
    if (!(radius > 0) || nearest >= radius * radius) return {};
    const double half = std::sqrt((radius * radius - nearest) / a);
    const Span span{std::max(0.0, -b / a - half), std::min(1.0, -b / a + half)};
    return span.begin < span.end ? Spans{span} : Spans{};
}

template <int Dim>
Spans box_spans(const Box<Dim>& box, const Vec<Dim>& p, const Vec<Dim>& q, double slack) {
    Span span{0, 1};
    for (int axis = 0; axis < Dim; ++axis) {
        const double low = box.low[axis] - slack - p[axis], high = box.high[axis] + slack - p[axis];
        const double along = q[axis] - p[axis];
        if (along == 0) {
            if (low > 0 || high < 0) return {};
            continue;
        }
        span.begin = std::max(span.begin, (along > 0 ? low : high) / along);
        span.end = std::min(span.end, (along > 0 ? high : low) / along);
    }
    return span.begin < span.end ? Spans{span} : Spans{};
}

/// What remains of `whole` where `taken` is taken away; both in order.
Spans without(const Spans& whole, const Spans& taken) {
    Spans rest;
    for (Span left : whole) {
        for (const Span& hole : taken) {
            if (hole.end <= left.begin || hole.begin >= left.end) continue;
            if (hole.begin > left.begin) rest.push_back({left.begin, hole.begin});
            left.begin = hole.end;
        }
        if (left.begin < left.end) rest.push_back(left);
    }
    return rest;
}

}  // namespace

template <int Dim>
double depth(const Shape<Dim>& shape, const Vec<Dim>& X) {
    return std::visit(Overloaded{
                          [&](const Box<Dim>& s) {
                              const Vec<Dim> beyond = (s.low - X).cwiseMax(X - s.high);
                              const double most = beyond.maxCoeff();
                              return most <= 0 ? -most : -beyond.cwiseMax(0).norm();
                          },
                          [&](const Disc<Dim>& s) { return s.radius - (X - s.centre).norm(); },
                          [&](const Ring<Dim>& s) {
                              const double r = (X - s.centre).norm();
                              return std::min(r - s.inner, s.outer - r);
                          },
                          [&](const Polygon& s) { return depth(s, X); },
                          [&](const Difference<Dim>& s) {
                              double least = depth(s.parts.front(), X);
                              for (std::size_t k = 1; k < s.parts.size(); ++k)
                                  least = std::min(least, -depth(s.parts[k], X));
                              return least;
                          },
                      },
                      shape.form);
}

template <int Dim>
bool inside(const Shape<Dim>& shape, const Vec<Dim>& X, double slack) {
    if (const auto* difference = std::get_if<Difference<Dim>>(&shape.form)) {
        const auto& parts = difference->parts;
        return inside(parts.front(), X, slack) &&
               std::none_of(parts.begin() + 1, parts.end(),
                            [&](const Shape<Dim>& part) { return inside(part, X, std::abs(slack)); });
    }
    return depth(shape, X) >= -slack;
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
bool is_convex(const Shape<Dim>& shape) {
    return std::visit(Overloaded{
                          [](const Box<Dim>&) { return true; },
                          [](const Disc<Dim>&) { return true; },
                          [](const Polygon& s) { return is_convex(s); },
                          [](const auto&) { return false; },
                      },
                      shape.form);
}

template <int Dim>
Spans spans(const Shape<Dim>& shape, const Vec<Dim>& p, const Vec<Dim>& q, double slack) {
    return std::visit(Overloaded{
                          [&](const Box<Dim>& s) { return box_spans(s, p, q, slack); },
                          [&](const Disc<Dim>& s) { return ball_spans(s.centre, s.radius + slack, p, q); },
                          [&](const Ring<Dim>& s) {
                              return without(ball_spans(s.centre, s.outer + slack, p, q),
                                             ball_spans(s.centre, s.inner - slack, p, q));
                          },
                          [&](const Polygon& s) { return spans(s, p, q, slack); },
                          [&](const Difference<Dim>& s) {
                              Spans rest = spans(s.parts.front(), p, q, slack);
                              for (std::size_t k = 1; k < s.parts.size(); ++k)
                                  rest = without(rest, spans(s.parts[k], p, q, -std::abs(slack)));
                              return rest;
                          },
                      },
                      shape.form);
}

template double depth<2>(const Shape<2>&, const Vec<2>&);
template bool inside<2>(const Shape<2>&, const Vec<2>&, double);
template Box<2> bounding_box<2>(const Shape<2>&);
template bool is_convex<2>(const Shape<2>&);
template Spans spans<2>(const Shape<2>&, const Vec<2>&, const Vec<2>&, double);

}  // namespace hibi
