#include "model/matter.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "model/sideways.hpp"

namespace hibi {

namespace {

constexpr double most_bend = 0.25, widest_joint = 0.5;  // of a spacing

/// A part of a way within one body. The way's legs are counted: 1.5 is the middle of the second one.
struct Piece {
    double begin = 0, end = 0;
    int body = 0;
    bool reached = false;
};

}  // namespace

template <int Dim>
Matter<Dim>::Matter(const Model<Dim>& model, const std::vector<int>& members)
    : model_(model),
      members_(members),
      boxes_(model.bodies.size()),
      convex_(model.bodies.size(), 0),
      near_a_side_(model.particles.count(), 0) {
    for (const int b : members) {
        const Body<Dim>& body = model.bodies[b];
        boxes_[b] = bounding_box(body.shape);
        convex_[b] = is_convex(body.shape);
        if (convex_[b]) continue;
        // A way that meets a side has one of its ends within half its length of it. Jitter may have brought
        // the particles of two cells closer.
        const double closer = std::sqrt(Dim) * body.lattice.jitter;
        const double reach = (model.influence / 2 + closer + slack_per_spacing) * body.spacing;
        parallel_for(body.end - body.begin, [&](int begin, int end) {
            for (int i = body.begin + begin; i < body.begin + end; ++i)
                near_a_side_[i] = depth(body.shape, model.cell_centre(i)) < reach;
        });
    }
}

template <int Dim>
bool Matter<Dim>::joins(int i, int j) const {
    const int from = model_.particles.body[i], to = model_.particles.body[j];
    if (from == to && (convex_[from] || (!near_a_side_[i] && !near_a_side_[j]))) return true;
    const Vec<Dim> a = model_.cell_centre(i), b = model_.cell_centre(j);
    if (along({a, b}, from, to)) return true;
    for (const Vec<Dim>& direction : sideways<Dim>(b - a)) {
        const Vec<Dim> bend = most_bend * model_.particles.spacing[i] * direction;
        for (const double slope : {0.25, 0.0}) {  // of the length, in which it bends aside and back
            const Vec<Dim> step = slope * (b - a) + bend, back = slope * (a - b) + bend;
            if (along({a, a + step, b + back, b}, from, to)) return true;
        }
    }
    return false;
}

template <int Dim>
bool Matter<Dim>::along(const std::vector<Vec<Dim>>& way, int from, int to) const {
    const double spacing = model_.bodies[from].spacing, slack = slack_per_spacing * spacing;
    const int legs = static_cast<int>(way.size()) - 1;
    const auto place = [&](double at) -> Vec<Dim> {
        const int leg = std::min(static_cast<int>(at), legs - 1);
        return way[leg] + (at - leg) * (way[leg + 1] - way[leg]);
    };
    Vec<Dim> low = way.front(), high = low;
    for (const Vec<Dim>& X : way) {
        low = low.cwiseMin(X);
        high = high.cwiseMax(X);
    }
    std::vector<Piece> pieces;
    for (const int body : members_) {
        const Shape<Dim>& shape = model_.bodies[body].shape;
        const Box<Dim>& box = boxes_[body];
        if ((box.low.array() > high.array() + slack).any() || (box.high.array() < low.array() - slack).any())
            continue;
        for (int leg = 0; leg < legs; ++leg) {
            bool goes_on =
                leg > 0 && !pieces.empty() && pieces.back().body == body && pieces.back().end == leg;
            for (const Span& span : spans(shape, way[leg], way[leg + 1], slack)) {
                if (goes_on && span.begin == 0)
                    pieces.back().end = leg + span.end;
                else
                    pieces.push_back({leg + span.begin, leg + span.end, body});
                goes_on = false;
            }
        }
    }
    const auto first =
        std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.body == from; });
    const auto last =
        std::find_if(pieces.rbegin(), pieces.rend(), [&](const Piece& p) { return p.body == to; });
    if (first == pieces.end() || first->begin > 0 || last == pieces.rend() || last->end < legs) return false;
    first->reached = true;
    // One body's pieces are apart, but another body may join them.
    const auto touch = [&](const Piece& a, const Piece& b) {
        if (a.body == b.body) return false;
        const Piece& left = a.begin < b.begin ? a : b;
        const Piece& right = a.begin < b.begin ? b : a;
        if (right.begin <= left.end) return true;
        const double gap = std::min(-depth(model_.bodies[right.body].shape, place(left.end)),
                                    -depth(model_.bodies[left.body].shape, place(right.begin)));
        return gap <= widest_joint * spacing + slack;
    };
    for (bool spreads = true; spreads;) {
        spreads = false;
        for (const Piece& a : pieces)
            for (Piece& b : pieces)
                if (a.reached && !b.reached && touch(a, b)) b.reached = spreads = true;
    }
    return last->reached;
}

template class Matter<2>;

}  // namespace hibi
