#include "image/flags.hpp"

#include <algorithm>

namespace hibi {

namespace {

/// The lowest rows for the sides chosen; false where two would have to be above each other.
bool find_rows(std::vector<Flag>& flags, double gap) {
    const auto over = [&](const Flag& words, double x) {
        return x > words.begin() - gap && x < words.end() + gap;
    };
    for (Flag& flag : flags) flag.row = 0;
    for (std::size_t pass = 0; pass <= flags.size(); ++pass) {
        bool changed = false;
        for (std::size_t i = 0; i < flags.size(); ++i)
            for (std::size_t j = 0; j < flags.size(); ++j) {
                Flag &upper = flags[i], &lower = flags[j];
                if (i == j || upper.row > lower.row) continue;
                const bool touch = upper.begin() < lower.end() + gap && lower.begin() < upper.end() + gap;
                const bool line_below = over(upper, lower.x);  // so it has to end below the words
                if (!line_below && (!touch || over(lower, upper.x) || i < j)) continue;
                upper.row = lower.row + 1;
                changed = true;
            }
        if (!changed) return true;
    }
    return false;
}

}  // namespace

bool place_flags(std::vector<Flag>& flags, double left, double right, double gap) {
    if (flags.size() > 8) return false;
    std::vector<Flag> best;
    int least = 1000;
    for (unsigned sides = 0; sides < 1u << flags.size(); ++sides) {
        std::vector<Flag> tried = flags;
        for (std::size_t k = 0; k < tried.size(); ++k) tried[k].to_left = !(sides >> k & 1);
        const bool inside =
            std::ranges::all_of(tried, [&](const Flag& f) { return f.begin() >= left && f.end() <= right; });
        if (!inside || !find_rows(tried, gap)) continue;
        int highest = 0;
        for (const Flag& flag : tried) highest = std::max(highest, flag.row);
        if (highest < least) least = highest, best = tried;
    }
    const bool found = least < 1000;
    if (found) flags = best;
    return found;
}

}  // namespace hibi
