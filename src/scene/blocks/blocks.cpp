#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// A block that is known but not built yet.
SceneBlock later(const std::string& name, KeyBlock::Form form, const std::string& meaning) {
    struct Nothing {};
    SceneBlock block{Block<Nothing>(name, form, meaning).keys};
    block.keys.available = false;
    block.read = [](const Value&, ReadContext&, Scene&) {};
    block.write = [](const Scene&) { return ""; };
    return block;
}

}  // namespace

const std::vector<SceneBlock>& bound_blocks() {
    using Form = KeyBlock::Form;
    static const std::vector<SceneBlock> blocks{
        top_block(),
        model_block(),
        material_block(),
        body_block(),
        notch_block(),
        fix_block(),
        load_block(),
        gravity_block(),
        damping_block(),
        run_block(),
        view_block(),
        movie_block(),
        strip_block(),
        test_block(),
        later("contact", Form::single, "Contact between bodies and fragments."),
        later("rigid", Form::list, "A rigid tool."),
    };
    return blocks;
}

}  // namespace hibi
