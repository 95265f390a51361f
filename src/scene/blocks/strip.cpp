#include "scene/blocks/blocks.hpp"

namespace hibi {

SceneBlock strip_block() {
    Block<StripSpec> strip("strip", KeyBlock::Form::single,
                           "Key frames: the pictures of strip.png and of the report.");
    strip.add("at", &StripSpec::at, "",
              "moments; what did not happen is left out, what happened at once shares a picture",
              R"(["first_break", "separation", "separation + 0.2 s"])");
    return single_block(strip, &Scene::strip);
}

}  // namespace hibi
