#include "scene/blocks/blocks.hpp"

namespace hibi {

SceneBlock gravity_block() {
    Block<Gravity> gravity("gravity", KeyBlock::Form::single, "Weight; absent: none.",
                           Gravity{Vec3(0, -9.80665, 0)});
    gravity.vector("acceleration", &Gravity::acceleration, "m/s^2", "of every particle",
                   R"(["0 m/s^2", "-9.81 m/s^2"])");
    return single_block(gravity, &Scene::gravity);
}

}  // namespace hibi
