#pragma once
#include <vector>

namespace hibi {

/// A part of a straight segment, from `begin` to `end`; 0 is its first point, 1 its last.
struct Span {
    double begin = 0, end = 0;
};
/// In order along the segment. Two that only touch are separated by a slit without width.
using Spans = std::vector<Span>;

}  // namespace hibi
