#include "record/run_folder.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "record/example.hpp"
#include "record/tables.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

using example::message_of;
namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

TEST(RunFolder, ReaderFindsWhatTheWriterWrote) {
    const TemporaryFolder folder;
    example::write_run(folder.path() / "out" / "run");
    const RunReader run(folder.path() / "out" / "run");
    EXPECT_EQ(run.topology().rest_length, example::topology().rest_length);
    EXPECT_EQ(run.summary().title, "Three in a row");
    EXPECT_EQ(run.history().rows.size(), 4u);
    EXPECT_EQ(run.broken_at(), (std::vector<double>{std::numeric_limits<double>::infinity(), 0.15}));
    ASSERT_EQ(run.states().size(), 4u);
    EXPECT_EQ(run.states()[2].step, 20);
    EXPECT_EQ(run.states()[2].time, 0.2);
    EXPECT_EQ(run.read(2).displacement, example::snapshot(20).displacement);
    EXPECT_EQ(run.extent(2).high.x(), 2 + 2 * (0.2 / 3));
}

TEST(RunFolder, HoldsTheFilesOfTheContractAndNoUnfinishedOnes) {
    const TemporaryFolder folder;
    example::write_run(folder.path());
    EXPECT_EQ(names_in(folder.path()),
              (std::vector<std::string>{"breaks.csv", "history.csv", "run.json", "scene.toml", "states",
                                        "states.hdf.series"}));
    EXPECT_EQ(
        names_in(folder.path() / "states"),
        (std::vector<std::string>{"000000.hdf", "000010.hdf", "000020.hdf", "000030.hdf", "topology.hdf"}));
    EXPECT_EQ(read_file(folder.path() / "scene.toml"), "version = 1\n");
}

TEST(RunFolder, SeriesListsEveryStateWithItsTime) {
    const TemporaryFolder folder;
    example::write_run(folder.path());
    const auto series = nlohmann::json::parse(read_file(folder.path() / "states.hdf.series"));
    ASSERT_EQ(series["files"].size(), 4u);
    EXPECT_EQ(series["files"][1]["name"], "states/000010.hdf");
    EXPECT_EQ(series["files"][1]["time"], 0.1);
}

TEST(RunFolder, DroppedStatesAreGoneEvenWhileTheyWait) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path());
        writer.topology(example::topology());
        writer.history_header({}, 2);
        for (int step = 0; step < 20; ++step) {
            writer.state(example::snapshot(step));
            if (step % 2 == 1) writer.drop_state(step);
        }
        writer.drop_state(1000);  // was never there
        writer.finish({});
    }
    const RunReader run(folder.path());
    ASSERT_EQ(run.states().size(), 10u);
    for (const StateInfo& state : run.states()) EXPECT_EQ(state.step % 2, 0);
    const auto series = nlohmann::json::parse(read_file(folder.path() / "states.hdf.series"));
    EXPECT_EQ(series["files"].size(), 10u);
}

TEST(RunFolder, StatesDroppedWhileTheyWaitAreNotWritten) {
    const TemporaryFolder folder;
    StageTimes times({});
    constexpr int count = 200;
    {
        RunWriter writer(folder.path(), {}, &times);
        writer.topology(example::topology());
        writer.history_header({}, 2);
        writer.state(example::snapshot(0));
        for (int step = 1; step < count; ++step) {  // the writer cannot keep up with this
            writer.state(example::snapshot(step));
            writer.drop_state(step);
        }
        writer.finish({});
    }
    EXPECT_EQ(RunReader(folder.path()).states().size(), 1u);
    EXPECT_LT(times.list().at(0).calls, count);
}

TEST(RunFolder, SecondStateOfAStepIsIgnored) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path());
        writer.topology(example::topology());
        writer.history_header({}, 2);
        writer.state(example::snapshot(5));
        Snapshot again = example::snapshot(5);
        again.time = 99;
        writer.state(again);
        writer.finish({});
    }
    const RunReader run(folder.path());
    ASSERT_EQ(run.states().size(), 1u);
    EXPECT_EQ(run.states()[0].time, 0.05);
}

TEST(RunFolder, NextRunRemovesWhatTheLastOneLeftAndNothingElse) {
    const TemporaryFolder folder;
    example::write_run(folder.path());
    fs::create_directories(folder.path() / "frames");
    for (const char* ours : {"movie.mp4", "movie.part.mp4", "poster.png", "frames.json", "frames/000000.png",
                             "states/000040.hdf.tmp"})
        write_file(folder.path() / ours, "old");
    for (const char* stranger : {"notes.txt", "my.csv", "states/measured.hdf", "states/12 apples.hdf"})
        write_file(folder.path() / stranger, "mine");
    const RunWriter writer(folder.path());
    EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"my.csv", "notes.txt", "states"}));
    EXPECT_EQ(names_in(folder.path() / "states"),
              (std::vector<std::string>{"12 apples.hdf", "measured.hdf"}));
}

TEST(RunFolder, KilledRunCanBeRead) {
    const TemporaryFolder folder;
    example::write_run(folder.path());
    // What a kill during the last state leaves: no summary, no list of states, half a file, half a line.
    fs::remove(folder.path() / "run.json");
    fs::remove(folder.path() / "states.hdf.series");
    fs::rename(folder.path() / "states/000030.hdf", folder.path() / "states/000030.hdf.tmp");
    const std::string history = read_file(folder.path() / "history.csv");
    write_file(folder.path() / "history.csv", history.substr(0, history.size() - 5));

    const RunReader run(folder.path());
    ASSERT_EQ(run.states().size(), 3u);
    EXPECT_EQ(run.history().rows.size(), 3u);
    EXPECT_EQ(run.summary().end_time, 0.2);
    EXPECT_EQ(run.summary().broken, 1);
    EXPECT_TRUE(run.summary().stopped);
}

TEST(RunFolder, FailedRunKeepsWhatWasRecorded) {
    const TemporaryFolder folder;
    {
        RunWriter writer(folder.path());
        writer.topology(example::topology());
        writer.history_header({}, 2);
        for (int step = 0; step < 5; ++step) writer.state(example::snapshot(step));
    }  // never finished
    EXPECT_EQ(RunReader(folder.path()).states().size(), 5u);
}

TEST(RunFolder, HistoryIsOnDiskBeforeTheStateThatFollowsIt) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path());
    writer.topology(example::topology());
    writer.history_header(example::load_names, 2);
    writer.row(example::row(0));
    writer.breaks({{0.15, 1, 1, 2, Vec3::Zero(), 0.1}});
    writer.state(example::snapshot(0));
    // What a kill at this moment would leave.
    EXPECT_EQ(read_history(folder.path() / "history.csv").rows.size(), 1u);
    EXPECT_EQ(read_breaks(folder.path() / "breaks.csv").size(), 1u);
}

TEST(RunFolder, DamagedStateIsNamedAndTheOthersCanStillBeRead) {
    const TemporaryFolder folder;
    example::write_run(folder.path());
    const RunReader run(folder.path());
    fs::resize_file(folder.path() / "states/000020.hdf", 1000);
    EXPECT_NE(message_of([&] { run.read(2); }).find("states/000020.hdf: "), std::string::npos);
    EXPECT_EQ(run.read(3).step, 30);
    EXPECT_NE(message_of([&] { RunReader again(folder.path()); }).find("states/000020.hdf: "),
              std::string::npos);
}

TEST(RunFolder, MissingFolderAndForeignFolderAreNamed) {
    const TemporaryFolder folder;
    EXPECT_NE(
        message_of([&] { RunReader run(folder.path() / "none"); }).find("none: there is no such folder"),
        std::string::npos);
    EXPECT_NE(message_of([&] { RunReader run(folder.path()); }).find("holds no recorded run"),
              std::string::npos);
}

TEST(RunFolder, FolderThatCannotBeMadeIsNamed) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "");
    EXPECT_NE(
        message_of([&] { RunWriter writer(folder.path() / "file"); }).find("/file: cannot create the folder"),
        std::string::npos);
}

TEST(RunFolder, FailureOfTheWriterThreadIsThrownByALaterCall) {
    const TemporaryFolder folder;
    RunWriter writer(folder.path());
    writer.topology(example::topology());
    writer.history_header({}, 2);
    fs::remove_all(folder.path() / "states");
    write_file(folder.path() / "states", "in the way");
    writer.state(example::snapshot(0));
    EXPECT_NE(message_of([&] { writer.finish({}); }).find("states/000000.hdf.tmp: cannot create"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder.path() / "run.json"));
}

}  // namespace
}  // namespace hibi
