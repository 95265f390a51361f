#include <algorithm>
#include <cmath>

#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// An influence radius that no lattice, or not this one, can have.
void check_influence(const Scene& scene, Problems& problems) {
    const std::string path = "model/influence";
    const double influence = scene.influence;
    if (!problems.fine(path)) return;
    const std::string label = fmt::format("[model] influence: {}", influence);
    if (influence < std::sqrt(2.0) - 1e-6) {
        problems.add(path,
                     label +
                         " is below sqrt 2 = 1.414: without the diagonal bonds the lattice would shear "
                         "freely",
                     "the default is 2.1");
        return;
    }
    if (influence > 8) {
        problems.add(path, label + " is above 8, hundreds of bonds per particle", "the default is 2.1");
        return;
    }
    // Where all is jittered, hardly a pair is at such a distance.
    const bool regular = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                     [](const BodySpec& body) { return body.lattice.jitter == 0; });
    for (int i = 1; regular && i <= 8; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(influence - std::hypot(i, j)) < 1e-6) {
                problems.add(
                    path, label + " is a distance of the lattice: rounding would decide who is a neighbour",
                    fmt::format("for example {:.2f}", std::hypot(i, j) + 0.1));
                return;
            }
}

}  // namespace

SceneBlock model_block() {
    Block<Scene> model("model", KeyBlock::Form::single, "The kind of model.");
    model.add("dimension", &Scene::dimension, "", "2; three dimensions are not available yet", "2");
    model.choice_of("assumption", &Scene::assumption,
                    {{"plane stress", Assumption::plane_stress}, {"plane strain", Assumption::plane_strain}},
                    "what happens across the plane", R"("plane strain")");
    model.add("thickness", &Scene::thickness, "m",
              "of the body, across the plane; forces are those of a body this thick", R"("0.2 m")", above(0));
    model.add("influence", &Scene::influence, "",
              "radius within which particles are bonded, in spacings; above sqrt 2", "2.1");
    model.choice_of(
        "elasticity", &Scene::elasticity,
        {{"moment-matched", Elasticity::moment_matched}, {"thesis", Elasticity::thesis}},
        "moment-matched: weights corrected at surfaces, rotation from the deformation; thesis: plain "
        "weights and an independent angle per particle, as in the first MPS papers",
        R"("thesis")");
    model.afterwards([](BlockReader& block, Scene& scene) {
        if (scene.dimension == 3)
            block.fail("dimension", "[model] dimension: three dimensions are not available yet");
        else if (scene.dimension != 2)
            block.fail("dimension", "[model] dimension needs 2 or 3");
    });
    SceneBlock result = single_block(
        model, [](auto& scene) -> auto& { return scene; });
    result.checks.push_back(check_influence);
    return result;
}

}  // namespace hibi
