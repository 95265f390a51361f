#include "scene/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "scene/blocks/blocks.hpp"

namespace hibi {

const Range::End* Range::passed_by(double value) const {
    // Not a number is beyond every end.
    if (is_limited_below() && !(low.included ? value >= low.value : value > low.value)) return &low;
    if (is_limited_above() && !(high.included ? value <= high.value : value < high.value)) return &high;
    return nullptr;
}

std::string Range::words() const {
    if (is_limited_below() && is_limited_above() && low.included && high.included)
        return fmt::format("from {} to {}", low.value, high.value);
    std::string text;
    if (is_limited_below())
        text = low.included ? fmt::format("{} or more", low.value) : fmt::format("above {}", low.value);
    if (is_limited_below() && is_limited_above()) text += " and ";
    if (is_limited_above())
        text += high.included ? fmt::format("{} or less", high.value) : fmt::format("below {}", high.value);
    return text;
}

const Key* KeyBlock::find(const std::string& key) const {
    for (const Key& k : keys)
        if (k.name == key) return &k;
    return nullptr;
}

std::vector<std::string> KeyBlock::key_names() const {
    std::vector<std::string> names;
    for (const Key& key : keys) names.push_back(key.name);
    return names;
}

const std::vector<KeyBlock>& scene_blocks() {
    static const std::vector<KeyBlock> all = [] {
        std::vector<KeyBlock> list;
        for (const SceneBlock& block : bound_blocks()) {
            list.push_back(block.keys);
            for (const KeyBlock& inner : block.inner)  // one of them may stand inside several blocks
                if (std::ranges::find(list, inner.name, &KeyBlock::name) == list.end()) list.push_back(inner);
        }
        return list;
    }();
    return all;
}

const KeyBlock& scene_block(const std::string& name) {
    for (const KeyBlock& block : scene_blocks())
        if (block.name == name) return block;
    throw std::out_of_range("no block " + name);
}

}  // namespace hibi
