#pragma once
#include <vector>

namespace hibi {

/// Words beside the upper end of an upright line.
struct Flag {
    double x = 0, width = 0;  ///< of the line; of the words and their distance from it
    bool to_left = true;      ///< on which side the words are
    int row = 0;              ///< from below; the line reaches up to it

    double begin() const { return to_left ? x - width : x; }
    double end() const { return to_left ? x : x + width; }
};

/// Sides and rows such that words stay between left and right, no words touch others and no line runs through
/// words; as few rows as that takes. False where there is no such way, or where there are more than eight.
bool place_flags(std::vector<Flag>& flags, double left, double right, double gap);

}  // namespace hibi
