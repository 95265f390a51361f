#include "picture_tests/diff.hpp"

#include <fmt/format.h>

namespace hibi {

namespace {

namespace fs = std::filesystem;

void refuse_inputs_as_output(const DiffOptions& options) {
    std::error_code none;
    for (const fs::path& input : {options.expected, options.actual})
        for (const char* name : {"expected.png", "actual.png", "heat.png"})
            if (fs::equivalent(input, options.output / name, none))
                refuse_to_compare(
                    fmt::format("{}: would be written over; choose another folder with -o", input.string()));
}

}  // namespace

void set_limits(const TestLimits& given, Tolerance& pixels, RunTolerance& run) {
    pixels.tile = given.tile.value_or(pixels.tile);
    pixels.pixels = given.pixels.value_or(pixels.pixels);
    pixels.mean = given.mean.value_or(pixels.mean);
    pixels.rmse = given.rmse.value_or(pixels.rmse);
    run.position = given.position.value_or(run.position);
    run.break_steps = given.break_steps.value_or(run.break_steps);
    run.load = given.load.value_or(run.load);
}

Findings diff(const DiffOptions& options) {
    refuse_inputs_as_output(options);
    const Findings f = find(options);
    fs::create_directories(options.output);
    for (const char* name : {"expected.png", "actual.png", "heat.png", "flicker.apng", "difference.html"})
        fs::remove(options.output / name);  // of an earlier comparison, which may have had pictures
    write_findings_page(f, options);
    if (options.junit) write_junit(*options.junit, "hibi diff", junit_cases(f, options));
    return f;
}

}  // namespace hibi
