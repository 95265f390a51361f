#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace hibi {

struct Video {
    int width = 0, height = 0;  ///< even
    int fps = 25;
    int threads = 0;                                ///< 0: the encoder's choice
    int quality = 18;                               ///< x264 constant rate factor
    std::map<std::string, std::string> metadata{};  ///< title, comment, ...
};

/// H.264 in MP4: yuv420p, BT.709 limited range, constant frame rate, a key frame every 25 frames or fewer.
/// Written as a fragmented file under a temporary name, so a killed run leaves a playable film; finish()
/// rewrites it with the index in front and gives it its name. Errors: std::runtime_error naming the file and
/// the operation.
class Encoder {
 public:
    Encoder(std::filesystem::path file, const Video& video);
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    /// BGRA pixels, top row first; stride in bytes.
    void add(const std::uint8_t* bgra, int stride);
    void finish();

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Name and version of the encoder in use, for `doctor`; empty where H.264 cannot be encoded here.
std::string encoder_name();

}  // namespace hibi
