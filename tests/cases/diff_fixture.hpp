#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "image/png.hpp"
#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {

namespace fs = std::filesystem;

inline Image picture(int bright = 0, int width = 96, int height = 64) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<std::uint8_t>(x + y + 20 * c);
    for (int k = 0; k < bright; ++k) image.pixel(40 + k % 10, 30 + k / 10)[2] = 255;
    return image;
}

class Diff : public testing::Test {
 protected:
    Answer diff(const std::string& arguments) const {
        return call("cd " + folder_.path().string() + " && " HIBI_PROGRAM " diff " + arguments);
    }
    fs::path at(const std::string& name) const { return folder_.path() / name; }
    void write(const std::string& name, const Image& image) const {
        fs::create_directories(at(name).parent_path());
        write_png(at(name), image);
    }
    /// What is answered where nothing can be compared: status 2, the file, a way out.
    void refuses(const std::string& arguments, const std::string& file, const std::string& words) const {
        const Answer answer = diff(arguments);
        EXPECT_EQ(answer.status, 2) << answer.out;
        EXPECT_NE(answer.out.find(file), std::string::npos) << answer.out;
        EXPECT_NE(answer.out.find(words), std::string::npos) << answer.out;
    }

    TemporaryFolder folder_;
};

}  // namespace hibi
