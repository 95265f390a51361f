#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

void read_method(BlockReader& block, RunSpec& run) {
    if (block.choice("method") == "static") run.statics.emplace();
}

void write_method(WrittenKeys& out, const RunSpec& run) {
    out.add("method", toml_text(std::string(run.statics ? "static" : "explicit")));
}

/// Rules between the keys of [run].
void finish_run(BlockReader& block, RunSpec& run) {
    if (!block.has("max_time")) {
        if (run.until && !run.until->event)
            run.max_time = run.until->offset;
        else
            block.fail("max_time", "missing key \"max_time\" in [run]", "for example: max_time = \"60 s\"");
    }
    for (const char* key : {"load_steps", "breaking"})
        if (block.has(key) && !run.statics && block.is_fine("method"))
            block.fail(key, fmt::format("[run] {} goes with method = \"static\"", key));
    if (run.time_step && run.time_step_factor)
        block.fail("time_step_factor", "[run] has both time_step and time_step_factor", "keep one of them");
}

}  // namespace

SceneBlock run_block() {
    Block<RunSpec> run("run", KeyBlock::Form::single, "How long, and in which steps.");
    run.keys.required = true;
    run.keys.if_missing = "it needs at least max_time = \"10 s\"";
    run.add("until", &RunSpec::until, "", "when the run ends", R"("separation + 0.5 s")",
            by_default("max_time"), ends_something);
    run.add("max_time", &RunSpec::max_time, "s", "when it ends at the latest", R"("60 s")",
            by_default("required, unless until is a time"), above(0));
    run.bound({"method", KeyKind::text, "",
               "explicit: motion in time; static: from equilibrium to equilibrium, while the loads rise with "
               "the time",
               R"("static")"},
              read_method, write_method, one_of({"explicit", "static"}));
    run.add(
        "load_steps", [](auto& spec) { return spec.statics ? &spec.statics->load_steps : nullptr; }, "",
        "with method static: in how many even steps max_time is reached", "100",
        by_default(toml_text(StaticSpec{}.load_steps)), at_least(1), at_most(1'000'000));
    run.choice_of(
        "breaking", [](auto& spec) { return spec.statics ? &spec.statics->sequential : nullptr; },
        {{"sequential", true}, {"together", false}},
        "with method static: sequential breaks one bond at a time, the others moving towards "
        "equilibrium until the next is at its limit; together breaks all that are beyond theirs in "
        "equilibrium",
        R"("together")", by_default("sequential"));
    run.add("time_step", &RunSpec::time_step, "s", "must be below the stable limit", R"("1 ms")",
            by_default("chosen"), above(0));
    run.add("time_step_factor", &RunSpec::time_step_factor, "", "the chosen time step over the stable limit",
            "0.5", by_default("0.8, or 0.5 where bonds can break"), above(0),
            below(1, "beyond 1 a run is not stable"));
    run.afterwards(finish_run);
    return single_block(run, &Scene::run);
}

}  // namespace hibi
