#include "film/comment.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace hibi {
namespace {

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255);
    return bytes;
}

std::string little_endian(std::uint32_t number) {
    std::string bytes = big_endian(number);
    std::ranges::reverse(bytes);
    return bytes;
}

/// Behind header and palette (GIF89a, 18 to 24).
void into_gif(std::string& file, const std::string& comment) {
    std::string block = "\x21\xfe";
    for (std::size_t i = 0; i < comment.size(); i += 255) {
        const std::string part = comment.substr(i, 255);
        block += static_cast<char>(part.size());
        block += part;
    }
    block += '\0';
    const int flags = static_cast<unsigned char>(file.at(10));
    file.insert(13 + (flags & 0x80 ? 3 * (std::size_t(2) << (flags & 7)) : 0), block);
}

/// Behind the first chunk, IHDR (PNG, 11.3.4.5).
void into_png(std::string& file, const std::string& comment) {
    const std::string data = std::string("iTXtComment\0\0\0\0\0", 16) + comment;
    const uLong check = crc32(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(data.size()));
    file.insert(33, big_endian(static_cast<std::uint32_t>(data.size() - 4)) + data +
                        big_endian(static_cast<std::uint32_t>(check)));
}

/// At the end; the chunk VP8X, the first one, says that it is there (WebP container, extended format).
void into_webp(std::string& file, const std::string& comment) {
    std::string text;
    for (const char c : comment) text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    const std::string packet =
        "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
        "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
        "<rdf:Description xmlns:dc=\"http://purl.org/dc/elements/1.1/\"><dc:description><rdf:Alt>"
        "<rdf:li xml:lang=\"x-default\">" +
        text + "</rdf:li></rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>";
    file += "XMP " + little_endian(static_cast<std::uint32_t>(packet.size())) + packet;
    if (packet.size() % 2) file += '\0';
    file.at(20) = static_cast<char>(file.at(20) | 0x04);
    file.replace(4, 4, little_endian(static_cast<std::uint32_t>(file.size() - 8)));
}

}  // namespace

void write_film_comment(const std::filesystem::path& path, const std::string& comment) {
    std::ifstream in(path, std::ios::binary);
    std::string file{std::istreambuf_iterator<char>(in), {}};
    if (file.starts_with("GIF8"))
        into_gif(file, comment);
    else if (file.starts_with("\x89PNG"))
        into_png(file, comment);
    else if (file.substr(8, 8) == "WEBPVP8X")
        into_webp(file, comment);
    else if (file.substr(8, 4) == "WEBP")
        return;  // one picture, in the simple layout, which has no place
    else
        throw std::runtime_error(fmt::format("{}: no place for a comment", path.string()));
    std::ofstream out(path, std::ios::binary);
    out.write(file.data(), static_cast<std::streamsize>(file.size()));
    out.close();
    if (!out) throw std::runtime_error(fmt::format("{}: cannot write the comment", path.string()));
}

}  // namespace hibi
