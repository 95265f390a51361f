#include <algorithm>

#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// Damping ratio of the first mode at which a load on a slow ramp finds the body nearly at its static state:
/// enough to still the swing within a period or two, and little lag.
constexpr double quasi_static_ratio = 0.3;

/// What damping = "quasi-static" stands for.
DampingSpec quasi_static(const Scene& scene) {
    DampingSpec damping{.damping = {.rate = {}, .ratio = quasi_static_ratio}};
    // Bonds that break while the load still rises belong to the quasi-static part; fragments fly.
    if (std::ranges::any_of(scene.materials, &Material::can_break) && !scene.loads.empty() &&
        !scene.fixes.empty())
        damping.until = Moment{EventName::separation, 0};
    return damping;
}

}  // namespace

SceneBlock damping_block() {
    Block<DampingSpec> damping(
        "damping", KeyBlock::Form::single,
        "Drag on every particle, in proportion to its mass; absent: none. In place of the block, above the "
        "first one: damping = \"quasi-static\", a ratio of 0.3 until separation.");
    damping.keys.words = {"quasi-static"};
    damping.add(
        "ratio", [](auto& spec) -> auto& { return spec.damping.ratio; }, "",
        "of the first mode of vibration; 1 just suppresses it. For bodies that are held", "0.3", above(0));
    damping.add(
        "rate", [](auto& spec) -> auto& { return spec.damping.rate; }, "1/s",
        "c in a = -c v, in place of ratio", R"("0.5 s^-1")", above(0));
    damping.add("until", &DampingSpec::until, "", "when it ends", R"("separation")", by_default("never"),
                ends_something);
    damping.afterwards([](BlockReader& block, DampingSpec&) { block.one_of({"ratio", "rate"}, "value"); });

    SceneBlock result = single_block(damping, &Scene::damping);
    result.read = [read = result.read](const Value& document, ReadContext& context, Scene& scene) {
        const Value* word = document.find("damping");
        if (word && word->kind == Value::Kind::text)
            scene.damping = quasi_static(scene);
        else
            read(document, context, scene);
    };
    return result;
}

}  // namespace hibi
