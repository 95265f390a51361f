#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"
#include "picture_tests/diff.hpp"
#include "picture_tests/findings.hpp"
#include "record/files.hpp"

namespace hibi {

namespace {

std::string place_words(const PositionsDifference::Place& p) {
    return fmt::format("{} = {:.2g} spacings, at t = {}, particle {} (X = {:.4g}, {:.4g} m)",
                       format_si(p.distance, "m"), p.spacings, format_si(p.time, "s", 4), p.particle,
                       p.reference_position.x(), p.reference_position.y());
}

DifferenceTable states_table(const RunDifference& d, const RunTolerance& tolerance) {
    DifferenceTable table{"States", "", {}};
    if (!d.other_body.empty()) {
        table.rows.push_back({"Body", d.other_body, "the same", false});
        return table;
    }
    table.note =
        fmt::format("{} moments that both runs recorded{}.", d.positions.compared,
                    d.positions.interpolated ? "; the second has another time step and is interpolated" : "");
    const std::string limit = fmt::format("{:g} spacings", tolerance.position);
    table.rows.push_back({"Largest difference of positions",
                          d.positions.largest ? place_words(*d.positions.largest) : "none", limit,
                          !d.positions.first_beyond});
    if (d.positions.first_beyond)
        table.rows.push_back({"First beyond the limit", place_words(*d.positions.first_beyond), "", {}});
    table.rows.push_back({"Broken bonds",
                          fmt::format("{}, expected {}", d.bonds.actual_broken, d.bonds.expected_broken),
                          "",
                          {}});
    table.rows.push_back({"Bonds that broke at another time or in one run only",
                          fmt::format("{}", d.bonds.changed), fmt::format("{} steps", tolerance.break_steps),
                          d.bonds.changed == 0});
    if (const auto& bond = d.bonds.first)
        table.rows.push_back({"First of them",
                              fmt::format("{}, at t = {}", describe(*bond), format_si(bond->time(), "s", 6)),
                              "",
                              {}});
    table.rows.push_back(
        {"End of the run",
         fmt::format("{}, expected {}", format_si(d.actual_end, "s", 6), format_si(d.expected_end, "s", 6)),
         "",
         {}});
    return table;
}

DifferenceTable curve_table(const CurveDifference& d, const RunTolerance& tolerance) {
    const double limit = tolerance.load * d.scale;
    const auto pair = [&](const char* name, const CurveDifference::Pair& p) {
        const auto words = [](const std::optional<double>& v) { return v ? format_si(*v, "N", 5) : "none"; };
        return DifferenceRow{
            name, fmt::format("{}, expected {}: {}", words(p.actual), words(p.expected), relative_change(p)),
            format_si(limit, "N"), p.same(limit)};
    };
    return {"Load",
            "",
            {pair("Peak load", d.peak),
             pair("Load at first break", d.first_break),
             {"Largest difference",
              fmt::format("{} at t = {}", format_si(d.largest, "N"), format_si(d.largest_time, "s", 4)),
              format_si(limit, "N"), !d.first_beyond}}};
}

DifferenceTable frames_table(const Findings& f, const Tolerance& tolerance) {
    constexpr std::size_t most = 50;
    DifferenceTable table{"Frames", "", {}};
    std::vector<const FrameDifference*> off;
    for (const FrameDifference& frame : f.frames)
        if (frame.sameness != Sameness::identical) off.push_back(&frame);
    table.note = fmt::format("{} of {} are identical.", f.frames.size() - off.size(), f.frames.size());
    std::ranges::stable_sort(off, std::greater{},
                             [&](const FrameDifference* frame) { return badness(*frame, tolerance); });
    if (off.size() > most) table.note += fmt::format(" The worst {} of the others:", most);
    for (std::size_t k = 0; k < std::min(most, off.size()); ++k)
        table.rows.push_back({off[k]->name,
                              fmt::format("worst tile {:.2f}, {:.3g} far pixels per megapixel",
                                          off[k]->pixels.tile, off[k]->pixels.pixels),
                              "", off[k]->sameness == Sameness::tolerated});
    return table;
}

}  // namespace

void write_findings_page(const Findings& f, const DiffOptions& options) {
    DifferencePage page{.title = "Difference",
                        .verdict = f.line(),
                        .differs = f.all() == Sameness::different,
                        .expected_name = options.expected.string(),
                        .actual_name = options.actual.string(),
                        .tables = {}};
    if (f.worst) {
        const Image expected = picture_to_compare(f.worst->expected, f.worst->number),
                    actual = picture_to_compare(f.worst->actual, f.worst->number);
        const std::string name = f.frames.size() > 1 ? "Worst frame: " + f.worst->name : std::string();
        page.pictures = page_pictures(name, expected, actual, f.worst->pixels);
        page.tables.push_back(pixel_table(f.worst->pixels, options.pixels));
        if (f.frames.size() > 1) page.tables.push_back(frames_table(f, options.pixels));
        write_difference_pictures(options.output, expected, actual, f.worst->pixels);
    } else if (!f.other_frames.empty()) {
        page.tables.push_back({"Frames", f.other_frames, {}});
    }
    if (!f.not_compared.empty()) {
        DifferenceTable table{
            "Not compared", "Files without pixels that differ, or that one side lacks.", {}};
        for (const std::string& name : f.not_compared) table.rows.push_back({name, "not the same", "", {}});
        page.tables.push_back(table);
    }
    if (f.run) {
        page.tables.push_back(states_table(*f.run, options.run));
        if (f.run->curve) page.tables.push_back(curve_table(*f.run->curve, options.run));
    }
    write_file(options.output / "difference.html", difference_page(page));
}

std::vector<JunitCase> junit_cases(const Findings& f, const DiffOptions& options) {
    std::vector<JunitCase> cases;
    for (const FrameDifference& frame : f.frames)
        cases.push_back({"pixels", frame.name, 0,
                         frame.sameness == Sameness::different ? beyond(frame.pixels, options.pixels) : ""});
    if (!f.other_frames.empty())
        cases.push_back({"pixels", "frames", 0, f.pixels == Sameness::different ? f.other_frames : ""});
    if (f.run)
        cases.push_back({"physics", "run", 0, f.run->same ? "" : physics_verdict(*f.run, options.run)});
    return cases;
}

}  // namespace hibi
