#include "app/schema_line.hpp"

#include <fmt/format.h>

#include <cctype>

namespace hibi {

namespace {

/// file:// and the path, with what an address cannot hold as %XX: editors end a bare path at a blank.
std::string address_of(const std::filesystem::path& file) {
    std::string address = "file://";
    for (const char c : std::filesystem::absolute(file).string()) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 128 && (std::isalnum(byte) || std::string_view("/-._~").find(c) != std::string_view::npos))
            address += c;
        else
            address += fmt::format("%{:02X}", byte);
    }
    return address;
}

}  // namespace

std::optional<std::filesystem::path> schema_file(const std::filesystem::path& program) {
    const std::filesystem::path folder = program.parent_path();
    for (const auto& file :
         {folder / "scene.schema.json", folder.parent_path() / "share/hibi/scene.schema.json"})
        if (std::filesystem::exists(file)) return file;
    return {};
}

std::string with_schema_line(std::string scene, const std::optional<std::filesystem::path>& schema) {
    if (scene.starts_with("#:schema ")) scene.erase(0, scene.find('\n') + 1);
    return schema ? fmt::format("#:schema {}\n{}", address_of(*schema), scene) : scene;
}

}  // namespace hibi
