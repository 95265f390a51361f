#include "image/png.hpp"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>

namespace hibi {

namespace {

// libpng reports errors by a callback that must not return. Throwing through its frames works where C code
// carries unwind tables, as all of Debian's does on x86-64 and arm64; the guards below free its structures.
[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }
void ignore_warning(png_structp, png_const_charp) {}

struct Writer {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore_warning);
    png_infop info = png_create_info_struct(png);
    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore_warning);
    png_infop info = png_create_info_struct(png);
    Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void append(png_structp png, png_bytep data, png_size_t size) {
    auto& bytes = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(png));
    bytes.insert(bytes.end(), data, data + size);
}

struct Source {
    const std::vector<unsigned char>& bytes;
    std::size_t at = 0;
};

void take(png_structp png, png_bytep data, png_size_t size) {
    Source& source = *static_cast<Source*>(png_get_io_ptr(png));
    if (source.bytes.size() - source.at < size) throw std::runtime_error("the file ends too early");
    std::copy_n(source.bytes.begin() + static_cast<std::ptrdiff_t>(source.at), size, data);
    source.at += size;
}

void set_text(const Writer& writer, const PngText& text) {
    std::vector<png_text> chunks;
    for (const auto& [key, value] : text) {
        png_text chunk{};
        const bool ascii =
            std::ranges::all_of(value, [](char c) { return static_cast<signed char>(c) >= 0; });
        chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(key.c_str());  // libpng copies both, and changes neither
        chunk.text = const_cast<char*>(value.c_str());
        chunks.push_back(chunk);
    }
    png_set_text(writer.png, writer.info, chunks.data(), static_cast<int>(chunks.size()));
}

Image decode(const std::vector<unsigned char>& bytes, PngText* text) {
    Reader reader;
    Source source{bytes};
    png_set_read_fn(reader.png, &source, take);
    png_read_info(reader.png, reader.info);
    constexpr double most_pixels = 1 << 28;  // a damaged header must not ask for all memory
    if (static_cast<double>(png_get_image_width(reader.png, reader.info)) *
            png_get_image_height(reader.png, reader.info) >
        most_pixels)
        throw std::runtime_error("it says to have more pixels than can be");
    Image image(static_cast<int>(png_get_image_width(reader.png, reader.info)),
                static_cast<int>(png_get_image_height(reader.png, reader.info)));
    png_set_expand(reader.png);
    png_set_strip_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_bgr(reader.png);
    image.transparent = png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_ALPHA ||
                        png_get_valid(reader.png, reader.info, PNG_INFO_tRNS);
    if (!image.transparent) png_set_filler(reader.png, 0, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    std::vector<png_bytep> rows;
    for (int y = 0; y < image.height; ++y) rows.push_back(image.pixel(0, y));
    png_read_image(reader.png, rows.data());
    png_read_end(reader.png, reader.info);
    if (image.transparent) to_premultiplied(image.bgra.data(), image.width * image.height);
    if (text) {
        png_textp chunks = nullptr;
        const int count = static_cast<int>(png_get_text(reader.png, reader.info, &chunks, nullptr));
        for (int i = 0; i < count; ++i) (*text)[chunks[i].key] = chunks[i].text;
    }
    return image;
}

/// What libpng would write of an opaque image with SUB filter, run lengths and zlib level 1, but in one
/// piece: an eighth faster than row by row.
void write_pixels(const Writer& writer, const Image& image) {
    constexpr std::uint8_t sub = 1;
    const std::size_t row_size = 1 + std::size_t(3) * image.width;
    thread_local std::vector<std::uint8_t> filtered, deflated;  // fresh memory for each frame is dear
    filtered.resize(row_size * image.height);
    for (int y = 0; y < image.height; ++y) {
        std::uint8_t* row = filtered.data() + y * row_size;
        row[0] = sub;
        to_rgb(image.pixel(0, y), 1, row + 1);
        const std::uint8_t* pixel = image.pixel(0, y);
        const auto difference = [&](int place) {
            return static_cast<std::uint8_t>(pixel[place] - pixel[place - 4]);
        };
        for (int x = 1; x < image.width; ++x) {
            row[1 + 3 * x] = difference(4 * x + 2);
            row[2 + 3 * x] = difference(4 * x + 1);
            row[3 + 3 * x] = difference(4 * x);
        }
    }
    z_stream z{};
    constexpr int level = 1, window = 15, memory = 9;
    if (deflateInit2(&z, level, Z_DEFLATED, window, memory, Z_RLE) != Z_OK) throw std::bad_alloc();
    z.next_in = filtered.data();
    z.avail_in = static_cast<uInt>(row_size * image.height);
    deflated.resize(deflateBound(&z, z.avail_in));
    z.next_out = deflated.data();
    z.avail_out = static_cast<uInt>(deflated.size());
    deflate(&z, Z_FINISH);
    deflateEnd(&z);
    png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IDAT"), deflated.data(), z.total_out);
    png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
}

}  // namespace

std::vector<unsigned char> encode_png(const Image& image, const PngOptions& options) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.bgra.size() / 4);
    Writer writer;
    png_set_write_fn(writer.png, &bytes, append, nullptr);
    png_set_IHDR(writer.png, writer.info, image.width, image.height, 8,
                 image.transparent ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options.small) {
        png_set_compression_level(writer.png, 9);
        png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    } else {
        png_set_compression_level(writer.png, 1);
        png_set_compression_strategy(writer.png, Z_RLE);
        png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    }
    set_text(writer, options.text);
    if (options.dpi > 0) {
        const auto per_metre = static_cast<png_uint_32>(options.dpi / 0.0254 + 0.5);
        png_set_pHYs(writer.png, writer.info, per_metre, per_metre, PNG_RESOLUTION_METER);
    }
    png_write_info(writer.png, writer.info);
    if (image.transparent) {
        std::vector<std::uint8_t> straight(image.bgra.size());
        to_straight(image, straight.data());
        png_set_bgr(writer.png);
        for (int y = 0; y < image.height; ++y)
            png_write_row(writer.png, straight.data() + y * image.stride());
    } else if (options.small) {
        std::vector<std::uint8_t> row(std::size_t(3) * image.width);
        for (int y = 0; y < image.height; ++y) {
            to_rgb(image.pixel(0, y), image.width, row.data());
            png_write_row(writer.png, row.data());
        }
    } else {
        write_pixels(writer, image);
        return bytes;
    }
    png_write_end(writer.png, writer.info);
    return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image, const PngOptions& options) {
    const std::vector<unsigned char> bytes = encode_png(image, options);
    const std::filesystem::path temporary = file.string() + ".tmp";
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot write the picture: " + std::strerror(errno));
    std::error_code error;
    std::filesystem::rename(temporary, file, error);
    if (!error) return;
    std::filesystem::remove(temporary);
    throw std::runtime_error(file.string() + ": cannot write the picture: " + error.message());
}

namespace {

/// The whole file, which begins as a PNG does.
std::vector<unsigned char> png_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": cannot open the picture: " + std::strerror(errno));
    std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(in), {}};
    if (bytes.size() < 8 || png_sig_cmp(bytes.data(), 0, 8) != 0)
        throw std::runtime_error(file.string() + ": not a PNG picture");
    return bytes;
}

}  // namespace

Image read_png(const std::filesystem::path& file, PngText* text) {
    const std::vector<unsigned char> bytes = png_bytes(file);
    try {
        return decode(bytes, text);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(file.string() + ": damaged PNG picture: " + error.what());
    }
}

bool is_animated_png(const std::filesystem::path& file) {
    // An animation says so before its first picture: acTL stands before IDAT. A chunk is its length, its
    // name, its content and a sum of four bytes.
    const std::vector<unsigned char> bytes = png_bytes(file);
    for (std::size_t at = 8; at + 8 <= bytes.size();) {
        const std::string name(bytes.begin() + at + 4, bytes.begin() + at + 8);
        if (name == "acTL") return true;
        if (name == "IDAT") return false;
        at += 12 + std::size_t(png_get_uint_32(bytes.data() + at));
    }
    return false;
}

int png_bit_depth(const std::filesystem::path& file) {
    // Signature, then length, name, width, height of the first chunk, IHDR.
    constexpr std::size_t place = 24;
    const std::vector<unsigned char> bytes = png_bytes(file);
    if (bytes.size() <= place)
        throw std::runtime_error(file.string() + ": damaged PNG picture: the file ends too early");
    return bytes[place];
}

}  // namespace hibi
