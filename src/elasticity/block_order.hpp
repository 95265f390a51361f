#pragma once
#include <vector>

#include "base/parallel.hpp"
#include "model/bonds.hpp"

namespace hibi {

/// In which order the blocks of particles are walked where something is first done to each block, and then,
/// once it is done to all blocks that a block's bonds lead to, something else. In a large body the second
/// follows the first at a short distance, and finds in the cache what that has left: whole segments of blocks
/// are walked so, and what touches another segment comes at the end.
class BlockOrder {
 public:
    explicit BlockOrder(const Bonds& bonds);

    /// Calls first(b) and second(b) once for every block b, spread over the threads.
    template <class First, class Second>
    void walk(const First& first, const Second& second) const {
        parallel_blocks(static_cast<int>(segments_.size()) - 1, [&](int s) {
            int behind = segments_[s];
            for (int b = segments_[s]; b < segments_[s + 1]; ++b) {
                first(b);
                for (; behind <= b && last_[behind] <= b; ++behind)
                    if (last_[behind] >= 0) second(behind);
            }
        });
        parallel_blocks(static_cast<int>(later_.size()), [&](int k) { second(later_[k]); });
    }

 private:
    std::vector<int> segments_;  ///< first block of each, and the end
    std::vector<int> last_;      ///< last block that a block's bonds lead to; -1: it comes later
    std::vector<int> later_;
};

}  // namespace hibi
