#include "scene/block.hpp"

#include <set>

#include "scene/scene_block.hpp"

namespace hibi {

std::string WrittenKeys::in_lines() const {
    std::string text;
    for (const auto& [key, value] : lines) text += fmt::format("{} = {}\n", key, value);
    return text;
}

std::string WrittenKeys::in_one_table() const {
    std::string text;
    for (const auto& [key, value] : lines)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
    return "{ " + text + " }";
}

void check_names(const std::vector<std::string>& names, const std::string& block, Problems& problems) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string path = fmt::format("{}/{}/name", block, i);
        if (names[i].empty() || names[i].find_first_of(",\"\n\r\t") != std::string::npos)
            problems.add(path,
                         fmt::format("[[{}]] name needs letters, without comma, quote or line break", block));
        else if (!seen.insert(names[i]).second)
            problems.add(path, fmt::format("[[{}]] name \"{}\" is taken already", block, names[i]),
                         "give it another name");
    }
}

}  // namespace hibi
