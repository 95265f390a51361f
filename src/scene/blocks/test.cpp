#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// Defaults are those of the command.
Block<TestLimits> tolerance_keys() {
    Block<TestLimits> limits("tolerance", KeyBlock::Form::inner,
                             "Limits within which `hibi test` counts a scene as the same.");
    limits.add("tile", &TestLimits::tile, "", "worst 32 x 32 tile: RMS difference of luma, in steps of 1/255",
               "4", by_default("3"), at_least(0));
    limits.add("pixels", &TestLimits::pixels, "", "pixels per megapixel with a channel off by more than 16",
               "20", by_default("8"), at_least(0));
    limits.add("mean", &TestLimits::mean, "", "mean signed difference of any channel, in steps of 1/255", "1",
               by_default("0.6"), at_least(0));
    limits.add("rmse", &TestLimits::rmse, "", "RMS difference of any channel, in steps of 1/255", "2",
               by_default("1.5"), at_least(0));
    limits.add("position", &TestLimits::position, "", "difference of positions, in particle spacings", "0.1",
               by_default("0.01"), at_least(0));
    limits.add("break_steps", &TestLimits::break_steps, "",
               "steps by which a bond may break earlier or later", "2", by_default("0"), at_least(0),
               at_most(1e9));
    limits.add("load", &TestLimits::load, "", "difference of loads, in parts of the peak load", "0.01",
               by_default("0.001"), at_least(0));
    return limits;
}

void check_params(BlockReader& block, TestSpec& test) {
    for (std::size_t i = 0; i < test.params.size(); ++i)
        if (const std::size_t equals = test.params[i].find('='); equals == 0 || equals == std::string::npos)
            block.fail(fmt::format("params/{}", i),
                       fmt::format("[test] params: \"{}\" is not of the form name=value", test.params[i]),
                       "for example: \"spacing=2 m\"");
}

}  // namespace

SceneBlock test_block() {
    Block<TestSpec> test("test", KeyBlock::Form::single,
                         "Pictures that `hibi test` compares with stored ones.");
    test.size("size", &TestSpec::width, &TestSpec::height, "pixels, even numbers", "[480, 270]");
    test.add("frames", &TestSpec::frames, "",
             "moments; what did not happen is left out, what happened at once shares a picture",
             R"(["first_break", "separation", "end"])");
    test.add("params", &TestSpec::params, "",
             "values of [params] for the test alone, as -p gives them: a coarser body, say",
             R"(["spacing=2 m"])");
    test.table(tolerance_keys(), &TestSpec::tolerance,
               "limits of this scene, where the usual ones do not fit", "{ break_steps = 2 }");
    test.afterwards(check_params);
    return single_block(test, &Scene::test);
}

}  // namespace hibi
