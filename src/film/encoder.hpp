#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace hibi {

struct Video {
    int width = 0, height = 0;  ///< even
    int fps = 25;
    int threads = 0;                                ///< 0: the encoder's choice
    int quality = 18;                               ///< x264 constant rate factor
    std::map<std::string, std::string> metadata{};  ///< title, comment, ...
    bool transparent = false;  ///< keep what the pictures have of it, where the format can
    Rgb background{};          ///< for what the format cannot keep
    double gif_limit = 10e6;   ///< bytes; a GIF becomes smaller until it holds
};

/// What a film can be, the usual first. Each is the extension of its file too.
/// mp4: H.264, yuv420p, BT.709 limited range. webm: VP9, with alpha. Both: constant frame rate, a key frame
/// every second. apng: exact. webp: animated, quality 80. gif: one palette, at most 960 pixels wide and 15
/// frames per second, fewer of both where its limit asks for it; a pixel is transparent or not.
const std::vector<std::string>& film_formats();

/// Takes pictures one by one and makes a film of them, under a temporary name that players open until it is
/// finished. Errors: std::runtime_error naming the file and the operation.
class Encoder {
 public:
    virtual ~Encoder() = default;
    virtual void add(const Image& image) = 0;
    /// Completes the file and gives it its name.
    virtual void finish() = 0;
};

/// The file's extension says the format. A killed program leaves a playable MP4.
std::unique_ptr<Encoder> open_encoder(const std::filesystem::path& file, const Video& video);

/// Name and version of the encoder in use, for `doctor`; empty where H.264 cannot be encoded here.
std::string encoder_name();

}  // namespace hibi
