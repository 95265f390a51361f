// The order of the rooms: which folder of src/ may include which other one, and which libraries it may know.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Table = std::map<std::string, std::set<std::string>>;

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        found.push_back((*it)[1]);
    return found;
}

/// Folder -> folders it may use: the rows of HIBI_LAYERS in CMakeLists.txt.
Table layers() {
    const std::string cmake = text_of(HIBI_SOURCE_DIR "/CMakeLists.txt");
    const std::size_t begin = cmake.find("set(HIBI_LAYERS");
    const std::string rows = cmake.substr(begin, cmake.find(')', begin) - begin);
    Table table;
    for (const std::string& row : all_matches(rows, std::regex("\"([^\"]+)\""))) {
        std::istringstream words(row.substr(row.find(':') + 1));
        std::set<std::string>& uses = table[row.substr(0, row.find(':'))];
        for (std::string word; words >> word;) uses.insert(word);
    }
    return table;
}

/// A library -> the only folders that may know it. Keys are patterns of what stands between < and >.
const std::vector<std::pair<std::string, std::set<std::string>>> rooms_of_libraries = {
    {"hdf5.*", {"record"}},
    {"libav.*|libsw.*", {"film"}},
    {"(GL|GLES.?|EGL)/.*", {"render"}},
    {"dlfcn\\.h", {"render", "algebra"}},  // OpenGL of one's choice; the threads of BLAS
    {"cholmod\\.h", {"algebra"}},
    {"cereal/.*", {"base"}},
    {"toml\\+\\+/.*", {"scene"}},
    {"cairo.*|png\\.h", {"image"}},
    {"ft2build\\.h|freetype.*", {"image"}},
    {"CLI/.*", {"app"}},
    {"nlohmann/.*", {"record", "scene", "report", "picture_tests", "app"}},
    {"udunits2\\.h|nettle/.*", {"base"}},
};

/// Every broken rule as "file: what it includes".
std::vector<std::string> offences_in(const fs::path& source, const Table& table) {
    static const std::regex own("(?:^|\n)[ \t]*#[ \t]*include[ \t]+\"([^\"]+)\"");
    static const std::regex foreign("(?:^|\n)[ \t]*#[ \t]*include[ \t]+<([^>]+)>");
    std::vector<std::string> offences;
    for (const auto& entry : fs::recursive_directory_iterator(source)) {
        if (!entry.is_regular_file()) continue;
        const std::string folder = fs::relative(entry.path(), source).begin()->string();
        const std::string text = text_of(entry.path());
        for (const std::string& header : all_matches(text, own)) {
            const std::string used = header.substr(0, header.find('/'));
            if (!table.contains(folder) || (used != folder && !table.at(folder).contains(used)))
                offences.push_back(entry.path().string() + ": \"" + header + "\"");
        }
        for (const std::string& header : all_matches(text, foreign))
            for (const auto& [pattern, rooms] : rooms_of_libraries)
                if (std::regex_match(header, std::regex(pattern)) && !rooms.contains(folder))
                    offences.push_back(entry.path().string() + ": <" + header + ">");
    }
    return offences;
}

/// The rooms that a room links: those of its row, those of theirs, and so on.
std::set<std::string> links_of(const std::string& room, const Table& table) {
    std::set<std::string> links;
    for (const std::string& used : table.at(room)) {
        links.insert(used);
        links.merge(links_of(used, table));
    }
    return links;
}

constexpr int most_lines = 400;
constexpr const char* long_for_a_reason = "Longer than 400 lines because ";

/// Files of a folder that are longer than they may be and do not say why in their first lines.
std::vector<std::string> too_long(const fs::path& source) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(source)) {
        if (!entry.is_regular_file()) continue;
        const std::string text = text_of(entry.path());
        const auto lines = std::ranges::count(text, '\n');
        if (lines > most_lines && text.substr(0, 600).find(long_for_a_reason) == std::string::npos)
            files.push_back(entry.path().string() + ": " + std::to_string(lines) + " lines");
    }
    return files;
}

TEST(Layers, TableIsReadFromTheBuildFile) {
    const Table table = layers();
    EXPECT_EQ(table.size(), 23u);  // the folders of src/
    EXPECT_TRUE(table.at("base").empty());
    EXPECT_EQ(table.at("record"), (std::set<std::string>{"base", "results"}));
}

TEST(Layers, TableHasNoCircle) {
    Table table = layers();
    // Take away folders that use none of those left, until nothing can be taken away.
    const auto uses_none_left = [&](const auto& row) {
        return std::ranges::none_of(row.second,
                                    [&](const std::string& used) { return table.contains(used); });
    };
    while (std::erase_if(table, uses_none_left) > 0) continue;
    for (const auto& row : table) ADD_FAILURE() << row.first << " is part of a circle";
}

TEST(Layers, NoFolderIncludesMoreThanItsRowAllows) {
    const std::vector<std::string> offences = offences_in(HIBI_SOURCE_DIR "/src", layers());
    for (const std::string& offence : offences) ADD_FAILURE() << offence;
}

TEST(Layers, WhatRecordsAndDrawsLinksNoSolver) {
    const Table table = layers();
    for (const char* room : {"results", "record", "image", "render", "film", "report"}) {
        const std::set<std::string> links = links_of(room, table);
        for (const char* solver : {"model", "elasticity", "physics", "simulation", "measure", "solve"})
            EXPECT_FALSE(links.contains(solver)) << room << " links " << solver;
    }
    EXPECT_TRUE(links_of("app", table).contains("physics"));
}

TEST(Layers, EveryFolderOfSourcesIsKnownToTheBuild) {
    const std::string cmake = text_of(HIBI_SOURCE_DIR "/CMakeLists.txt");
    const Table table = layers();
    const fs::path source = HIBI_SOURCE_DIR "/src";
    for (const auto& entry : fs::recursive_directory_iterator(source)) {
        if (!entry.is_directory()) continue;
        const fs::path folder = fs::relative(entry.path(), source);
        const std::string inner = folder.filename().string();
        EXPECT_TRUE(folder == inner ? table.contains(inner)
                                    : cmake.find("/" + inner + "/") != std::string::npos)
            << folder;
    }
}

TEST(Layers, NoSourceIsLongWithoutAReason) {
    for (const std::string& file : too_long(HIBI_SOURCE_DIR "/src")) ADD_FAILURE() << file;
}

TEST(Layers, LongSourcesAreSeenUnlessTheySayWhy) {
    const fs::path source = fs::temp_directory_path() / "hibi-long-sources-test";
    fs::create_directories(source / "physics");
    const std::string lines(most_lines, '\n');
    std::ofstream(source / "physics" / "just_right.cpp") << lines;
    std::ofstream(source / "physics" / "table.cpp") << "// " << long_for_a_reason << "it is one table.\n"
                                                    << lines;
    std::ofstream(source / "physics" / "everything.cpp") << "// All of it.\n" << lines;
    const std::vector<std::string> files = too_long(source);
    fs::remove_all(source);
    ASSERT_EQ(files.size(), 1u);
    EXPECT_TRUE(files[0].ends_with("everything.cpp: 401 lines"));
}

TEST(Layers, OffencesAreSeen) {
    const fs::path source = fs::temp_directory_path() / "hibi-layers-test";
    fs::create_directories(source / "physics");
    std::ofstream(source / "physics" / "a.cpp")
        << "#include \"base/vec.hpp\"\n#include <vector>\n"
        << "#include \"physics/b.hpp\"\n  #  include \"record/files.hpp\"\n"
        << "#include <hdf5.h>\n#include <GL/gl.h>\n";
    const std::vector<std::string> offences = offences_in(source, layers());
    fs::remove_all(source);
    ASSERT_EQ(offences.size(), 3u);
    EXPECT_TRUE(offences[0].ends_with("\"record/files.hpp\""));
    EXPECT_TRUE(offences[1].ends_with("<hdf5.h>"));
    EXPECT_TRUE(offences[2].ends_with("<GL/gl.h>"));
}

}  // namespace
