// hibi diff as a user calls it: pictures, frames and runs; what differs, and what cannot be compared.
#include "picture_tests/diff.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/units.hpp"
#include "cases/diff_fixture.hpp"
#include "measure/run_monitor.hpp"
#include "record/files.hpp"
#include "record/tables.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"
#include "solve/recorder.hpp"

namespace hibi {
namespace {

using Json = nlohmann::json;

TEST_F(Diff, SaysWhetherPicturesAreIdenticalWithinToleranceOrDifferent) {
    write("a.png", picture());
    write("same.png", picture());
    Image rounded = picture();
    ++rounded.pixel(3, 3)[0];
    write("rounded.png", rounded);
    write("other.png", picture(30));
    Answer answer = diff("a.png same.png");
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out, "same (identical)\nout/diff/difference.html\n");
    answer = diff("a.png rounded.png");
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out.substr(0, 23), "same (within tolerance)");
    answer = diff("a.png other.png --junit j/unit.xml");
    EXPECT_EQ(answer.status, 3);
    EXPECT_EQ(answer.out.substr(0, 22), "different (worst tile ") << answer.out;
    EXPECT_NE(answer.out.find(", at (32, 16);"), std::string::npos) << answer.out;  // x, then y
    EXPECT_NE(
        read_file(at("out/diff/difference.html")).find("<tr class=\"wrong\"><th scope=\"row\">worst tile"),
        std::string::npos);
    for (const char* name : {"expected.png", "actual.png", "heat.png", "flicker.apng", "difference.html"})
        EXPECT_TRUE(fs::exists(at("out/diff") / name)) << name;
    EXPECT_EQ(pixel_hash(read_png(at("out/diff/actual.png"))), pixel_hash(picture(30)));
    EXPECT_NE(read_file(at("j/unit.xml")).find("failures=\"1\""), std::string::npos);

    // Every limit can be moved.
    EXPECT_EQ(diff("a.png other.png --tile 99 --pixels 1e6 --mean 99 --rmse 99").status, 0);
    EXPECT_EQ(diff("a.png rounded.png --tile 0").status, 3);
}

TEST_F(Diff, AnswersInJson) {
    write("a.png", picture());
    write("b.png", picture(30));
    const Json json = Json::parse(diff("a.png b.png --json").out);
    EXPECT_EQ(json["verdict"], "different");
    EXPECT_EQ(json["pixels"]["frames"][0]["far_pixels"], 30);
    EXPECT_TRUE(json["states"].is_null());
    EXPECT_TRUE(json["curve"].is_null());
    EXPECT_EQ(Json::parse(diff("a.png a.png --json").out)["verdict"], "same");
}

TEST_F(Diff, ComparesFoldersAndFindsTheWorstFrame) {
    for (const char* name : {"a/0.png", "a/1.png", "a/2.png", "b/0.png"}) write(name, picture());
    write("b/1.png", picture(2));
    write("b/2.png", picture(30));
    const Answer answer = diff("a b");
    EXPECT_EQ(answer.status, 3);
    EXPECT_EQ(answer.out.find("different (2 of 3 frames, worst 2.png: "), 0u) << answer.out;
    EXPECT_NE(read_file(at("out/diff/difference.html")).find("1 of 3 are identical."), std::string::npos);
    // The order of the names decides nothing.
    for (const char* name : {"c/0.png", "c/1.png", "c/2.png"}) write(name, picture(name[2] == '0' ? 30 : 0));
    EXPECT_EQ(diff("a c").out.find("different (1 of 3 frames, worst 0.png: "), 0u);
    write("a/3.png", picture());
    refuses("a b", "b: lacks 1 of 4 frames, the first of them 3.png", "compare films of the same length");
    refuses("b a", "b: lacks 1 of 4 frames", "draw this one again");
}

// Each measure is weighed by its limit, and one that holds is never worse than one that does not.
TEST_F(Diff, TheWorstFrameIsTheOneFurthestBeyondItsLimits) {
    const auto brighter = [](int by) {
        Image image = picture(0, 128, 96);
        for (std::size_t k = 0; k < image.bgra.size(); k += 4)
            for (int c = 0; c < 3; ++c)
                image.bgra[k + c] = static_cast<std::uint8_t>(image.bgra[k + c] / 2 + by);
        return image;
    };
    // 16 steps: 26.7 times the limit of the mean. Two pixels: 163 per megapixel, 20.3 times theirs.
    Image two = brighter(0);
    two.pixel(5, 5)[2] = two.pixel(9, 5)[2] = 255;
    for (const char* name : {"a/0.png", "a/1.png"}) write(name, brighter(0));
    write("b/0.png", brighter(16));
    write("b/1.png", two);
    EXPECT_EQ(diff("a b").out.find("different (2 of 2 frames, worst 0.png: "), 0u) << diff("a b").out;

    // One pixel is allowed in so small a picture, though it is 81 per megapixel.
    two = brighter(0);
    two.pixel(5, 5)[2] = 55;  // from 25
    write("b/0.png", brighter(2));
    write("b/1.png", two);
    EXPECT_EQ(diff("a b").out.find("different (1 of 2 frames, worst 0.png: "), 0u) << diff("a b").out;
}

TEST_F(Diff, OfOddSizesLeavesOutALineOfTheFlickerAlone) {
    write("a.png", picture(0, 95, 63));
    write("b.png", picture(30, 95, 63));
    EXPECT_EQ(diff("a.png b.png").status, 3);
    EXPECT_TRUE(fs::exists(at("out/diff/flicker.apng")));
    EXPECT_EQ(read_png(at("out/diff/heat.png")).width, 95);
}

TEST_F(Diff, RefusesWhatCannotBeCompared) {
    write("a.png", picture());
    write("wide.png", Image(98, 64));
    refuses("a.png none.png", "none.png", "no such file");
    refuses("a.png wide.png", "wide.png: one picture has 96 x 64 pixels, the other 98 x 64", "same [view]");
    fs::copy(at("a.png"), at("cut.png"));
    for (const auto size : {fs::file_size(at("a.png")) - 20, fs::file_size(at("a.png")) / 2,
                            std::uintmax_t{30}, std::uintmax_t{0}}) {
        fs::resize_file(at("cut.png"), size);
        refuses("a.png cut.png", "cut.png", "compare whole PNG pictures");
    }
    // Sixteen bits per channel, of one pixel: header, one row, end, as the PNG specification has them.
    std::ofstream(at("deep.png"), std::ios::binary)
        << std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x10\x02\0\0\0", 29);
    refuses("deep.png a.png", "deep.png: has 16 bits per channel", "convert it first");
    std::ofstream(at("text.png")) << "no picture at all";
    refuses("text.png a.png", "text.png: not a PNG picture", "");
    std::ofstream(at("film.mp4")) << "";
    refuses("film.mp4 film.mp4", "film.mp4: cannot open the film", "compare whole films");
    std::ofstream(at("notes.txt")) << "no picture";
    refuses("notes.txt notes.txt", "notes.txt: cannot be compared", "frames.json");
    fs::create_directories(at("empty"));
    refuses("empty empty", "empty: holds no picture", "");
    refuses("a.png empty", "a.png is a picture, empty is", "two of a kind");
    fs::create_directories(at("here"));
    fs::copy(at("a.png"), at("here/expected.png"));
    refuses("here/expected.png a.png -o here", "here/expected.png: would be written over", "-o");
    refuses("a.png here/expected.png -o here", "here/expected.png: would be written over", "-o");
    std::ofstream(at("frames.json")) << "[{]";
    refuses("frames.json frames.json", "frames.json: not a list of frames", "");
}

/// Runs the small scene, with one bond stronger than it should be: only where both ends are of the strong
/// material is a bond's limit that of the strong one.
void record(const Scene& scene, const fs::path& folder, const std::optional<std::array<int, 2>>& strong) {
    Built<2> built = build(scene);
    const Topology topology = topology_of(scene, built);
    if (strong) {
        Material stronger = built.model.materials[0];
        stronger.break_strain = 1.1 * *stronger.break_strain;
        built.model.materials.push_back(stronger);
        for (const int particle : *strong) built.model.particles.material[particle] = 1;
    }
    SimulationIn<2> simulation(std::move(built.model), std::move(built.physics));
    const auto monitor = make_run_monitor(simulation);
    RunWriter writer(folder);
    writer.scene(write_scene(scene));
    writer.topology(topology);
    Recorder recorder(scene, simulation, *monitor, writer);
    while (simulation.time() < 30) {
        simulation.step();
        monitor->look();
        recorder.look();
    }
    recorder.finish();
    RunSummary summary;
    summary.time_step = simulation.time_step();
    summary.steps = simulation.steps();
    summary.broken = simulation.broken();
    summary.end_time = simulation.time();
    summary.events = monitor->events();
    writer.finish(summary);
}

TEST_F(Diff, TwoRunsThatDifferByOneBondsStrengthAreToldApartByThatBond) {
    const Scene scene = parse_scene(small_scene, "small.toml");
    record(scene, at("plain"), {});
    const std::vector<Break> breaks = read_breaks(at("plain/breaks.csv"));
    ASSERT_FALSE(breaks.empty());
    const Break& first = breaks.front();
    record(scene, at("strong"), std::array{first.first, first.second});

    const std::string bond = fmt::format("bond {}-{}", first.first, first.second);
    const std::string moment =
        fmt::format("physics changed first at t = {}: {}", format_si(first.time, "s", 4), bond);
    Answer answer = diff("plain strong");
    EXPECT_EQ(answer.status, 3);
    EXPECT_EQ(answer.out.find(moment), 0u) << answer.out << moment;
    // Neither was drawn: of an earlier comparison no picture stays.
    write("a.png", picture());
    ASSERT_EQ(diff("a.png a.png").status, 0);
    answer = diff("strong plain --json --junit unit.xml");
    EXPECT_EQ(answer.status, 3);
    EXPECT_FALSE(fs::exists(at("out/diff/heat.png")));
    EXPECT_TRUE(fs::exists(at("out/diff/difference.html")));
    EXPECT_NE(read_file(at("unit.xml")).find("failures=\"1\""), std::string::npos);
    const Json json = Json::parse(answer.out);
    EXPECT_EQ(json["verdict"].get<std::string>().find(moment), 0u) << json["verdict"];
    EXPECT_EQ(json["states"]["first_bond"]["particles"], Json({first.first, first.second}));
    EXPECT_EQ(json["states"]["first_bond"]["actual_time"], first.time);
    const Events expected = RunReader(at("strong")).summary().events;
    EXPECT_EQ(json["curve"]["peak_load"]["expected"], expected.peak_load->load);
    EXPECT_EQ(json["curve"]["first_break_load"]["expected"], expected.first_break->load);
    EXPECT_NE(expected.peak_load->load, expected.first_break->load);
    EXPECT_EQ(diff("plain plain").out.substr(0, 16), "same (identical)");
}

TEST_F(Diff, ADamagedRunIsRefused) {
    record(parse_scene(small_scene, "small.toml"), at("a"), {});
    fs::copy(at("a"), at("b"), fs::copy_options::recursive);
    EXPECT_EQ(diff("a b").status, 0);
    std::vector<fs::path> states;
    for (const auto& entry : fs::directory_iterator(at("b/states"))) states.push_back(entry.path());
    std::ranges::sort(states);
    const fs::path state = states[states.size() / 2];
    const auto whole = fs::file_size(state);
    for (const auto size : {whole - 100, whole / 2, std::uintmax_t{10}, std::uintmax_t{0}}) {
        fs::resize_file(state, size);
        refuses("a b", state.filename().string(), "run the scene again");
    }
    fs::remove(state);
    refuses("a b", state.filename().string() + ": is missing", "run the scene again");
    fs::copy(at("a/states") / state.filename(), state);
    fs::resize_file(at("b/breaks.csv"), fs::file_size(at("b/breaks.csv")) - 5);
    refuses("a b", "breaks.csv", "run the scene again");
    fs::copy(at("a/breaks.csv"), at("b/breaks.csv"), fs::copy_options::overwrite_existing);
    for (const auto size : {fs::file_size(at("b/history.csv")) - 5, std::uintmax_t{300}, std::uintmax_t{0}}) {
        fs::resize_file(at("b/history.csv"), size);
        refuses("a b", "history.csv", "run the scene again");
    }
    fs::remove(at("b/states/topology.hdf"));
    refuses("a b", "b is a film's frames", "two of a kind");
}

TEST_F(Diff, TellsAChangedDrawingFromChangedPhysics) {
    // The least film that is drawn: one picture of a second.
    std::string text = small_scene;
    text += "[view]\nsize = [128, 96]\n[movie]\nduration = 1\nfps = 2\n";
    text.replace(text.find("\"4 m\""), 5, "\"10 m\"");
    std::ofstream(at("dark.toml")) << text;
    std::string light = text;
    light.replace(light.find("size = [128"), 0, "theme = \"light\"\n");
    std::ofstream(at("light.toml")) << light;
    const std::string run = "cd " + folder_.path().string() + " && " HIBI_PROGRAM " run -q --no-report ";
    ASSERT_EQ(call(run + "dark.toml -o dark").status % 4, 0);
    ASSERT_EQ(call(run + "light.toml -o light").status % 4, 0);
    Answer answer = diff("dark light");
    EXPECT_EQ(answer.status, 3);
    EXPECT_EQ(answer.out.find("drawing changed, physics the same (2 of 2 frames"), 0u) << answer.out;
    EXPECT_EQ(diff("dark/frames.json light/frames.json").status, 3);
    EXPECT_EQ(diff("dark/frames.json dark/frames.json").status, 0);
    // That one has a frame more is a finding.
    const std::string listed = read_file(at("light/frames.json"));
    Json fewer = Json::parse(listed);
    fewer.erase(fewer.size() - 1);
    std::ofstream(at("light/frames.json")) << fewer;
    answer = diff("dark light --junit unit.xml");
    EXPECT_EQ(answer.status, 3);
    EXPECT_EQ(answer.out.find("drawing changed, physics the same (1 frames, not 2)"), 0u) << answer.out;
    EXPECT_NE(read_file(at("unit.xml")).find("failures=\"1\""), std::string::npos);
    std::ofstream(at("light/frames.json")) << listed;
    fs::remove(at("light/frames/000001.png"));
    refuses("dark/frames.json light/frames.json", "000001.png: is missing", "hibi render");
    refuses("dark light", "000001.png: is missing", "hibi render");
}

}  // namespace
}  // namespace hibi
