#include "app/diff.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "app/junit.hpp"
#include "app/picture_files.hpp"
#include "app/process.hpp"
#include "base/units.hpp"
#include "film/encoder.hpp"
#include "image/png.hpp"
#include "record/files.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

enum class Kind { picture, frames, run };
const char* to_string(Kind kind) {
    return kind == Kind::picture ? "a picture" : kind == Kind::frames ? "a film's frames" : "a run";
}

Kind kind_of(const fs::path& path) {
    if (!fs::exists(path)) refuse(path.string() + ": there is no such file or folder");
    if (fs::is_directory(path))
        return fs::exists(path / "states" / "topology.hdf") ? Kind::run : Kind::frames;
    if (is_picture(path)) return Kind::picture;
    if (path.extension() == ".json") return Kind::frames;
    refuse(
        fmt::format("{}: cannot be compared; name a picture or a film (PNG, JPEG, GIF, MP4, WebM; not "
                    "animated WebP), a folder of them, the frames.json of a film, or the folder of a run",
                    path.string()));
}

/// What reading a file complains of is the user's matter here: the file is the input.
template <class Read>
auto as_input(const char* way_out, Read&& read) {
    try {
        return read();
    } catch (const std::runtime_error& error) {
        refuse(fmt::format("{}; {}", error.what(), way_out));
    }
}

NamedFiles listed_frames(const fs::path& folder) {
    NamedFiles frames;
    for (const FrameInfo& frame :
         as_input("draw the film again with hibi render", [&] { return read_frames(folder); })) {
        frames[frame.file] = folder / frame.file;
        if (!fs::exists(folder / frame.file))
            refuse(
                fmt::format("{}: is missing, though frames.json lists it; draw the film again: hibi render",
                            (folder / frame.file).string()));
    }
    return frames;
}

/// The frames that a frames.json lists, or everything that a folder holds.
FolderFiles files_to_compare(const fs::path& path, const fs::path& output) {
    FolderFiles files;
    if (path.extension() == ".json") {
        if (path.filename() != "frames.json")
            refuse(path.string() + ": not the list of a film's frames; it is called frames.json");
        files.pictures = listed_frames(path.has_parent_path() ? path.parent_path() : fs::path("."));
    } else {
        files = as_input("compare folders that can be read", [&] { return files_of(path, output); });
        if (fs::exists(path / "frames.json")) files.pictures.merge(listed_frames(path));
    }
    if (files.pictures.empty())
        refuse(path.string() + ": holds no picture, film, frames.json or recorded run; nothing to compare");
    return files;
}

/// Throws where one of the two has frames that the other lacks.
void require_same_names(const NamedFiles& expected, const NamedFiles& actual, const DiffOptions& options) {
    const auto lacks = [](const NamedFiles& all, const NamedFiles& some, const fs::path& where) {
        std::vector<std::string> missing;
        for (const auto& [name, file] : all)
            if (!some.contains(name)) missing.push_back(name);
        if (missing.empty()) return;
        refuse(fmt::format(
            "{}: lacks {} of {} frames, the first of them {}; compare films of the same length, or "
            "draw this one again",
            where.string(), missing.size(), all.size(), missing.front()));
    };
    lacks(expected, actual, options.actual);
    lacks(actual, expected, options.expected);
}

/// Every picture of every file.
std::vector<FrameDifference> compare_files(const NamedFiles& expected, const NamedFiles& actual,
                                           const Tolerance& tolerance) {
    const std::vector<NamedFiles::value_type> files(expected.begin(), expected.end());
    std::vector<std::vector<FrameDifference>> of_file(files.size());
    in_parallel(
        static_cast<int>(files.size()), std::max(1, static_cast<int>(std::thread::hardware_concurrency())),
        [&](int k) {
            const auto& [name, file] = files[k];
            of_file[k] = compare_pictures(name, file, actual.at(name), tolerance);
        },
        [] {});
    std::vector<FrameDifference> list;
    for (const auto& frames : of_file) list.insert(list.end(), frames.begin(), frames.end());
    return list;
}

/// By how much it is beyond, or how near to, the limits: at most 1 where all hold.
double badness(const FrameDifference& frame, const Tolerance& tolerance) {
    double worst = 0;
    for (const Measure& m : measures(frame.pixels, tolerance)) {
        const double share = m.limit > 0 ? m.value / m.limit : m.value > 0 ? INFINITY : 0.0;
        worst = std::max(worst, m.holds ? std::min(1.0, share) : share);
    }
    return worst;
}

Sameness worst_of(const std::vector<FrameDifference>& frames) {
    Sameness worst = Sameness::identical;
    for (const FrameDifference& f : frames) worst = std::max(worst, f.sameness);
    return worst;
}

Json pixels_json(const PixelDifference& d) {
    return {{"tile", d.tile}, {"tile_at", d.tile_at}, {"pixels", d.pixels},   {"far_pixels", d.far_pixels},
            {"mean", d.mean}, {"rmse", d.rmse},       {"largest", d.largest}, {"ssim", d.ssim}};
}

Json limits_json(const Tolerance& t) {
    return {{"tile", t.tile}, {"pixels", t.pixels}, {"mean", t.mean}, {"rmse", t.rmse}};
}

/// Everything that was found, from which verdict, JSON, page and JUnit are made.
struct Findings {
    std::vector<FrameDifference> frames{};
    const FrameDifference* worst = nullptr;
    std::string other_frames{};  ///< why the frames of two runs are not compared
    std::vector<std::string> not_compared{};  ///< files that are not the same, and have no pixels to compare
    std::optional<RunDifference> run{};
    Sameness pixels = Sameness::identical, physics = Sameness::identical;
    std::string verdict{}, detail{};  ///< detail may be empty

    std::string line() const { return detail.empty() ? verdict : fmt::format("{} ({})", verdict, detail); }
    Sameness all() const { return std::max(pixels, physics); }
};

std::string drawing_words(const Findings& f, const DiffOptions& options) {
    if (!f.other_frames.empty()) return f.other_frames;
    const auto differing = std::ranges::count(f.frames, Sameness::different, &FrameDifference::sameness);
    std::string text = f.frames.size() == 1 ? ""
                                            : fmt::format("{} of {} frames, worst {}: ", differing,
                                                          f.frames.size(), f.worst->name);
    return text + beyond(f.worst->pixels, options.pixels);
}

std::string not_compared_words(const std::vector<std::string>& names) {
    constexpr std::size_t most = 3;
    const std::size_t shown = std::min(most, names.size());
    std::string text = fmt::format("not the same, but not compared: {}",
                                   fmt::join(names.begin(), names.begin() + shown, ", "));
    if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

void set_verdict(Findings& f, const DiffOptions& options) {
    if (f.all() != Sameness::different) {
        f.verdict = "same";
        f.detail = to_string(f.all());
    } else if (f.physics == Sameness::different) {
        f.verdict = physics_verdict(*f.run, options.run);
    } else {
        f.verdict = f.run ? "drawing changed, physics the same" : "different";
        f.detail = drawing_words(f, options);
    }
    if (!f.not_compared.empty()) f.detail += "; " + not_compared_words(f.not_compared);
}

Json place_json(const std::optional<PositionsDifference::Place>& place) {
    if (!place) return nullptr;
    const Vec3& X = place->reference_position;
    return {{"distance", place->distance},
            {"spacings", place->spacings},
            {"time", place->time},
            {"particle", place->particle},
            {"position", {X.x(), X.y(), X.z()}}};
}

/// JSON has no infinity: null where it did not break.
Json time_json(double time) { return std::isfinite(time) ? Json(time) : Json(nullptr); }

Json states_json(const RunDifference& d) {
    if (!d.other_body.empty()) return {{"other_body", d.other_body}};
    Json first = nullptr;
    if (const auto& bond = d.bonds.first)
        first = {{"bond", bond->bond},
                 {"particles", {bond->first, bond->second}},
                 {"expected_time", time_json(bond->expected)},
                 {"actual_time", time_json(bond->actual)},
                 {"steps", bond->steps}};
    return {{"other_body", nullptr},
            {"moments", d.positions.compared},
            {"interpolated", d.positions.interpolated},
            {"largest", place_json(d.positions.largest)},
            {"first_beyond", place_json(d.positions.first_beyond)},
            {"broken", {{"expected", d.bonds.expected_broken}, {"actual", d.bonds.actual_broken}}},
            {"changed_bonds", d.bonds.changed},
            {"first_bond", first}};
}

Json pair_json(const CurveDifference::Pair& pair) {
    const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); };
    return {{"expected", value(pair.expected)}, {"actual", value(pair.actual)}};
}

Json curve_json(const RunDifference& d) {
    if (!d.curve) return nullptr;
    return {{"peak_load", pair_json(d.curve->peak)},
            {"first_break_load", pair_json(d.curve->first_break)},
            {"largest", d.curve->largest},
            {"largest_time", d.curve->largest_time},
            {"first_beyond", d.curve->first_beyond ? Json(*d.curve->first_beyond) : Json(nullptr)}};
}

std::string to_json(const Findings& f, const DiffOptions& options) {
    Json pixels = nullptr;
    if (!f.other_frames.empty())
        pixels = {{"sameness", f.pixels == Sameness::different ? Json(to_string(f.pixels)) : Json(nullptr)},
                  {"obstacle", f.other_frames}};
    if (f.worst) {
        Json frames = Json::array();
        for (const FrameDifference& frame : f.frames) {
            Json row{{"name", frame.name}, {"sameness", to_string(frame.sameness)}};
            row.update(pixels_json(frame.pixels));
            frames.push_back(row);
        }
        pixels = {{"sameness", to_string(f.pixels)},
                  {"limits", limits_json(options.pixels)},
                  {"worst", f.worst->name},
                  {"frames", frames}};
    }
    const Json json{{"verdict", f.verdict},
                    {"detail", f.detail},
                    {"sameness", to_string(f.all())},
                    {"pixels", pixels},
                    {"not_compared", f.not_compared},
                    {"states", f.run ? states_json(*f.run) : Json(nullptr)},
                    {"curve", f.run ? curve_json(*f.run) : Json(nullptr)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

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

void write_page(const Findings& f, const DiffOptions& options) {
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

/// The pictures of two runs, where both were drawn. That one has more of them is a finding, not a mistake.
void compare_drawings(const DiffOptions& options, Findings& f) {
    const auto frames_of = [](const fs::path& folder) {
        return fs::exists(folder / "frames.json") ? listed_frames(folder) : NamedFiles{};
    };
    const NamedFiles expected = frames_of(options.expected), actual = frames_of(options.actual);
    if (expected.empty() || actual.empty()) {
        f.other_frames = fmt::format("{} has no frames, so pixels are not compared; hibi render draws them",
                                     (expected.empty() ? options.expected : options.actual).string());
        return;
    }
    if (expected.size() != actual.size()) {
        f.other_frames = fmt::format("{} frames, not {}", actual.size(), expected.size());
        f.pixels = Sameness::different;
        return;
    }
    f.frames = compare_files(expected, actual, options.pixels);
}

/// A run that came to its end has all the states, rows and breaks that it counted: what is gone must not pass
/// unseen.
void require_complete(const RunReader& run) {
    if (run.summary().stopped) return;
    const auto broken =
        std::ranges::count_if(run.broken_at(), [](double time) { return std::isfinite(time); });
    if (broken != run.summary().broken)
        throw std::runtime_error(fmt::format("{}: holds {} broken bonds, and run.json counts {}",
                                             (run.folder() / "breaks.csv").string(), broken,
                                             run.summary().broken));
    const std::vector<HistoryRow>& rows = run.history().rows;
    if (rows.empty() || rows.back().time < run.summary().end_time)
        throw std::runtime_error(
            fmt::format("{}: ends before the run does", (run.folder() / "history.csv").string()));
    const fs::path series = run.folder() / "states.hdf.series";
    try {
        const Json list = Json::parse(read_file(series));
        for (const Json& state : list.at("files"))
            if (const fs::path file = run.folder() / state.at("name").get<std::string>(); !fs::exists(file))
                throw std::runtime_error(fmt::format("{}: is missing, though {} lists it", file.string(),
                                                     series.filename().string()));
    } catch (const Json::exception& error) {
        throw std::runtime_error(fmt::format("{}: not a list of states: {}", series.string(), error.what()));
    }
}

Findings find(const DiffOptions& options) {
    const Kind kind = kind_of(options.expected), other = kind_of(options.actual);
    if (kind != other)
        refuse(fmt::format("{} is {}, {} is {}; compare two of a kind", options.expected.string(),
                           to_string(kind), options.actual.string(), to_string(other)));
    Findings f;
    if (kind == Kind::picture) {
        f.frames = compare_pictures(options.actual.filename().string(), options.expected, options.actual,
                                    options.pixels);
    } else if (kind == Kind::frames) {
        const FolderFiles expected = files_to_compare(options.expected, options.output),
                          actual = files_to_compare(options.actual, options.output);
        require_same_names(expected.pictures, actual.pictures, options);
        f.frames = compare_files(expected.pictures, actual.pictures, options.pixels);
        f.not_compared = differing_files(expected.others, actual.others);
    } else {
        f.run = as_input("run the scene again, or compare other runs", [&] {
            const RunReader expected(options.expected), actual(options.actual);
            require_complete(expected);
            require_complete(actual);
            return difference(expected, actual, options.run);
        });
        f.physics = f.run->identical ? Sameness::identical
                    : f.run->same    ? Sameness::tolerated
                                     : Sameness::different;
        compare_drawings(options, f);
    }
    if (!f.frames.empty()) {
        f.pixels = worst_of(f.frames);
        f.worst = &*std::ranges::max_element(
            f.frames, {}, [&](const FrameDifference& frame) { return badness(frame, options.pixels); });
    }
    set_verdict(f, options);
    return f;
}

void refuse_inputs_as_output(const DiffOptions& options) {
    std::error_code none;
    for (const fs::path& input : {options.expected, options.actual})
        for (const char* name : {"expected.png", "actual.png", "heat.png"})
            if (fs::equivalent(input, options.output / name, none))
                refuse(
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

std::vector<FrameDifference> compare_pictures(const std::string& name, const fs::path& expected,
                                              const fs::path& actual, const Tolerance& tolerance) {
    // Of formats that count hundredths of a second, and of those that count exactly.
    constexpr double most_off = 0.02;
    PictureSequence left(expected), right(actual);
    std::vector<FrameDifference> frames;
    const auto refuse_pair = [&](const std::string& why, const char* way_out) {
        refuse(fmt::format("{}, {}: {}; {}", expected.string(), actual.string(), why, way_out));
    };
    for (int number = 0;; ++number) {
        const std::optional<FilmFrame> a = left.next(), b = right.next();
        if (!a && !b) break;
        if (!a || !b)
            refuse_pair(fmt::format("the {} one ends after {} pictures", a ? "second" : "first", number),
                        "compare films of the same length");
        if (std::abs(a->time - b->time) > most_off)
            refuse_pair(fmt::format("picture {} is shown at {:.3f} s in one, at {:.3f} s in the other",
                                    number, a->time, b->time),
                        "compare films of the same speed");
        FrameDifference frame{name, expected, actual, {}, {}, number};
        try {
            frame.pixels = difference(a->image, b->image);
        } catch (const std::invalid_argument& error) {
            refuse_pair(error.what(), "draw both with the same [view]");
        }
        frame.sameness = judge(frame.pixels, tolerance);
        frames.push_back(frame);
    }
    if (frames.empty()) refuse_pair("they hold no picture", "compare whole films");
    if (frames.size() > 1)
        for (FrameDifference& frame : frames) frame.name += fmt::format(", picture {}", frame.number);
    return frames;
}

std::string beyond(const PixelDifference& d, const Tolerance& tolerance) {
    std::string text;
    for (const Measure& m : measures(d, tolerance)) {
        if (m.holds) continue;
        text += fmt::format("{}{} {:.3g}, limit {:g}", text.empty() ? "" : "; ", m.name, m.value, m.limit);
        if (m.name == "worst tile") text += fmt::format(", at ({}, {})", d.tile_at[0], d.tile_at[1]);
    }
    return text;
}

DifferenceTable pixel_table(const PixelDifference& d, const Tolerance& tolerance) {
    DifferenceTable table{"Pixels", "In steps of 1/255.", {}};
    for (const Measure& m : measures(d, tolerance))
        table.rows.push_back({m.name, fmt::format("{:.4g}", m.value), fmt::format("{:g}", m.limit), m.holds});
    const auto triple = [](const std::array<double, 3>& v) {
        return fmt::format("{:.3g}, {:.3g}, {:.3g}", v[0], v[1], v[2]);
    };
    table.rows.push_back({"mean difference of R, G, B", triple(d.mean), "", {}});
    table.rows.push_back({"RMS difference of R, G, B", triple(d.rmse), "", {}});
    table.rows.push_back({"largest difference", fmt::format("{}", d.largest), "", {}});
    table.rows.push_back({"pixels far off", fmt::format("{}", d.far_pixels), "", {}});
    table.rows.push_back({"structural similarity", fmt::format("{:.5f}", d.ssim), "", {}});
    return table;
}

DifferencePage::Pictures page_pictures(const std::string& name, const Image& expected, const Image& actual,
                                       const PixelDifference& d) {
    const auto png = [](const Image& image) {
        const std::vector<unsigned char> bytes = encode_png(image, {.small = true});
        return std::string(bytes.begin(), bytes.end());
    };
    DifferencePage::Pictures pictures{name,           png(expected),
                                      png(actual),    png(heat_map(expected, actual, d)),
                                      expected.width, expected.height};
    if (!d.identical)
        pictures.tile = {d.tile_at[0], d.tile_at[1], std::min(expected.width, PixelDifference::tile_size),
                         std::min(expected.height, PixelDifference::tile_size)};
    return pictures;
}

void write_difference_pictures(const fs::path& folder, const Image& expected, const Image& actual,
                               const PixelDifference& d) {
    write_png(folder / "expected.png", expected);
    write_png(folder / "actual.png", actual);
    write_png(folder / "heat.png", heat_map(expected, actual, d));
    // Films have even sizes: an odd line or column is left out.
    const int width = expected.width / 2 * 2, height = expected.height / 2 * 2;
    if (width == 0 || height == 0) return;
    const auto film = open_encoder(folder / "flicker.apng", {.width = width, .height = height, .fps = 2});
    for (const Image* image : {&expected, &actual}) {
        Image even(width, height);
        even.transparent = image->transparent;
        for (int y = 0; y < height; ++y) std::copy_n(image->pixel(0, y), 4 * width, even.pixel(0, y));
        film->add(even);
    }
    film->finish();
}

int diff_command(const DiffOptions& options) {
    refuse_inputs_as_output(options);
    const Findings f = find(options);
    fs::create_directories(options.output);
    for (const char* name : {"expected.png", "actual.png", "heat.png", "flicker.apng", "difference.html"})
        fs::remove(options.output / name);  // of an earlier comparison, which may have had pictures
    write_page(f, options);
    if (options.junit) write_junit(*options.junit, "hibi diff", junit_cases(f, options));
    if (options.json)
        fmt::print("{}", to_json(f, options));
    else
        fmt::print("{}\n{}\n", f.line(), (options.output / "difference.html").string());
    return f.all() == Sameness::different ? 3 : 0;
}

}  // namespace hibi
