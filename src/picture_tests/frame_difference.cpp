#include "picture_tests/frame_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "base/process.hpp"
#include "film/encoder.hpp"
#include "image/png.hpp"

namespace hibi {

namespace fs = std::filesystem;

std::vector<FrameDifference> compare_pictures(const std::string& name, const fs::path& expected,
                                              const fs::path& actual, const Tolerance& tolerance) {
    // Of formats that count hundredths of a second, and of those that count exactly.
    constexpr double most_off = 0.02;
    PictureSequence left(expected), right(actual);
    std::vector<FrameDifference> frames;
    const auto refuse_pair = [&](const std::string& why, const char* way_out) {
        refuse_to_compare(fmt::format("{}, {}: {}; {}", expected.string(), actual.string(), why, way_out));
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

double badness(const FrameDifference& frame, const Tolerance& tolerance) {
    double worst = 0;
    for (const Measure& m : measures(frame.pixels, tolerance)) {
        const double share = m.limit > 0 ? m.value / m.limit : m.value > 0 ? INFINITY : 0.0;
        worst = std::max(worst, m.holds ? std::min(1.0, share) : share);
    }
    return worst;
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

}  // namespace hibi
