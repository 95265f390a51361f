// hibi diff as a user calls it: everything in folders, films and animations, and pictures by what they show.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/diff_fixture.hpp"
#include "film/encoder.hpp"
#include "image/difference.hpp"
#include "record/files.hpp"

namespace hibi {
namespace {

using Json = nlohmann::json;

TEST_F(Diff, ComparesEveryPictureOfAFolderWhateverItIsCalledAndHoweverDeepItLies) {
    for (const char* name : {"2.PNG", "deep/er/1.png", ".hidden.png", "1.Png"}) {
        SCOPED_TRACE(name);
        fs::remove_all(at("a"));
        fs::remove_all(at("b"));
        for (const char* side : {"a/", "b/"})
            for (const char* other : {"0.png", "deep/0.png"}) write(side + std::string(other), picture());
        write("a/" + std::string(name), picture());
        write("b/" + std::string(name), picture());
        EXPECT_EQ(diff("a b").out.find("same (identical)\n"), 0u) << diff("a b").out;
        write("b/" + std::string(name), picture(30));
        const Answer answer = diff("a b");
        EXPECT_EQ(answer.status, 3);
        EXPECT_EQ(answer.out.find(fmt::format("different (1 of 3 frames, worst {}: ", name)), 0u)
            << answer.out;
        fs::remove(at("b/" + std::string(name)));
        refuses("a b", "b: lacks 1 of 3 frames, the first of them " + std::string(name), "");
        refuses("b a", "b: lacks 1 of 3 frames, the first of them " + std::string(name), "");
    }
    // Another case is another name.
    write("c/1.png", picture());
    write("d/1.PNG", picture());
    refuses("c d", "d: lacks 1 of 1 frames, the first of them 1.png", "");
}

TEST_F(Diff, FollowsLinksAndLooksNotIntoItsOwnFolder) {
    for (const char* name : {"a/0.png", "b/0.png", "elsewhere/1.png"}) write(name, picture());
    write("changed/1.png", picture(30));
    fs::create_directory_symlink("../elsewhere", at("a/link"));
    fs::create_directory_symlink("../changed", at("b/link"));
    EXPECT_EQ(diff("a b").out.find("different (1 of 2 frames, worst link/1.png"), 0u) << diff("a b").out;
    fs::remove(at("b/link"));
    fs::create_directory_symlink("../elsewhere", at("b/link"));
    // A folder in itself holds nothing new.
    fs::create_directory_symlink(".", at("a/self"));
    fs::create_directory_symlink("../a", at("elsewhere/up"));
    EXPECT_EQ(diff("a b").status, 2) << diff("a b").out;  // by another way it does
    fs::remove(at("elsewhere/up"));
    for (int k = 0; k < 2; ++k) {
        const Answer answer = diff("a b -o a/differences");
        EXPECT_EQ(answer.out.find("same (identical)\n"), 0u) << answer.out;
    }
    fs::create_symlink("nowhere.png", at("a/broken.png"));
    EXPECT_EQ(diff("a b -o a/differences")
                  .out.find("same (identical; not the same, but not compared: broken.png)\n"),
              0u)
        << diff("a b -o a/differences").out;
}

TEST_F(Diff, NamesWhatItCannotCompare) {
    for (const char* name : {"a/0.png", "b/0.png"}) write(name, picture());
    const auto put = [&](const std::string& name, const std::string& text) {
        fs::create_directories(at(name).parent_path());
        std::ofstream(at(name)) << text;
    };
    put("a/same.txt", "text");
    put("b/same.txt", "text");
    EXPECT_EQ(diff("a b").out.find("same (identical)\n"), 0u) << diff("a b").out;
    put("a/curve.svg", "<svg/>");
    put("b/curve.svg", "<svg />");
    Answer answer = diff("a b");
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out.find("same (identical; not the same, but not compared: curve.svg)\n"), 0u)
        << answer.out;
    EXPECT_NE(read_file(at("out/diff/difference.html")).find("curve.svg"), std::string::npos);
    put("a/sub/one.csv", "1");
    put("b/two.csv", "2");
    put("b/three.csv", "3");
    EXPECT_EQ(Json::parse(diff("a b --json").out)["not_compared"],
              Json({"curve.svg", "sub/one.csv", "three.csv", "two.csv"}));
    EXPECT_EQ(diff("a b").out.find(
                  "same (identical; not the same, but not compared: curve.svg, sub/one.csv, three.csv and 1 "
                  "more)\n"),
              0u)
        << diff("a b").out;
}

TEST_F(Diff, ComparesEveryFrameOfFilmsAndAnimations) {
    const auto film = [&](const std::string& name, int frames, int changed, int fps = 5) {
        fs::create_directories(at(name).parent_path());
        const auto encoder = open_encoder(at(name), {.width = 96, .height = 64, .fps = fps});
        for (int k = 0; k < frames; ++k) encoder->add(picture(k == changed ? 200 : 10 * k));
        encoder->finish();
    };
    for (const std::string type : {"apng", "gif", "mp4", "webm"}) {
        SCOPED_TRACE(type);
        for (const char* name : {"one.", "two.", "a/film.", "b/film."}) film(name + type, 5, -1);
        film("changed." + type, 5, 3);
        film("b/film." + type, 5, 3);
        film("short." + type, 4, -1);
        film("fast." + type, 5, -1, 10);
        EXPECT_EQ(diff("one." + type + " two." + type).out.find("same (identical)\n"), 0u);
        for (const std::string& pair : {"one." + type + " changed." + type, std::string("a b")}) {
            const Answer answer = diff(pair);
            EXPECT_EQ(answer.status, 3);
            EXPECT_NE(answer.out.find("." + type + ", picture 3: "), std::string::npos) << answer.out;
        }
        // The pictures beside the page are those of that frame.
        EXPECT_FALSE(
            difference(read_png(at("out/diff/expected.png")), read_png(at("out/diff/actual.png"))).identical);
        refuses("one." + type + " short." + type, "the second one ends after 4 pictures", "same length");
        refuses("short." + type + " one." + type, "the first one ends after 4 pictures", "same length");
        refuses("one." + type + " fast." + type, "picture 1 is shown at 0.200 s in one, at 0.100 s",
                "same speed");
        for (const char* side : {"a/", "b/"}) fs::remove(at(side + ("film." + type)));
    }
    // An animation in a file that is called .png is one, too.
    for (const char* name : {"one", "changed"})
        fs::rename(at(std::string(name) + ".apng"), at(std::string(name) + ".png"));
    EXPECT_EQ(diff("one.png changed.png").status, 3);
    // No library of this program reads animated WebP: it is said.
    film("a/film.webp", 5, -1);
    film("b/film.webp", 5, 3);
    refuses("a/film.webp b/film.webp", "a/film.webp: cannot be compared", "animated WebP");
    for (const char* name : {"a/0.png", "b/0.png"}) write(name, picture());
    EXPECT_EQ(diff("a b").out.find("same (identical; not the same, but not compared: film.webp)\n"), 0u)
        << diff("a b").out;
}

TEST_F(Diff, ComparesPicturesAndNotTheWayTheyAreStored) {
    write("rgb.png", picture());
    Image alpha = picture();
    alpha.transparent = true;
    for (std::size_t k = 3; k < alpha.bgra.size(); k += 4) alpha.bgra[k] = 255;
    write("rgba.png", alpha);
    EXPECT_EQ(diff("rgb.png rgba.png").out.find("same (identical)\n"), 0u);
    EXPECT_EQ(diff("rgba.png rgb.png").out.find("same (identical)\n"), 0u);
    for (int x = 0; x < 40; ++x)
        for (int c = 0; c < 4; ++c) alpha.pixel(x, 20)[c] = 0;
    write("hole.png", alpha);
    EXPECT_EQ(diff("rgb.png hole.png").status, 3);
    EXPECT_EQ(diff("hole.png rgb.png").status, 3);
}

}  // namespace
}  // namespace hibi
