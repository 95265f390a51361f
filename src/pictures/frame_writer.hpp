#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "film/encoder.hpp"
#include "image/png.hpp"
#include "record/run_folder.hpp"

namespace hibi {

/// Takes finished frames from the thread that draws them: some threads hash and write them as PNG, one
/// encodes them in order, in every format. Holds a fixed number of pictures, so a slow disk or encoder makes
/// the drawing wait. An error of any thread is thrown by the next call.
class FrameWriter {
 public:
    /// movie.EXTENSION for every format; workers = 0: no PNG and no hash.
    /// `profile` takes what the threads do, and for how long a picture was waited for.
    FrameWriter(std::filesystem::path folder, int workers, const std::vector<std::string>& formats,
                const Video& video, StageTimes* profile = nullptr);
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// An image to draw on, waiting for one if need be. Its pixels are those of some earlier frame.
    Image take();
    /// Frames come in rising order without a gap. The hash of `info` is filled in. Where a `poster` is named,
    /// the frame is that picture, too.
    void add(Image image, FrameInfo info, PngText text, const std::filesystem::path& poster = {});
    /// Waits for everything; the film gets its name. Entries in the order of the frames.
    std::vector<FrameInfo> finish();
    double encode_seconds() const;  ///< time spent in the encoders; after finish()

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hibi
