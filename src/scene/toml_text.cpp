#include "scene/toml_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hibi {

std::string toml_text(double value) { return fmt::format("{}", value); }

std::string toml_text(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '\n')
            result += "\\n";
        else if (c == '\r')
            result += "\\r";
        else if (c == '\t')
            result += "\\t";
        else
            result += c;
    }
    return result + "\"";
}

std::string toml_text(const Field& field) {
    return field.is_constant() ? toml_text(field(Vec3::Zero(), 0)) : toml_text(field.text());
}

std::string toml_text(const Vec<2>& point) { return fmt::format("[{}, {}]", point.x(), point.y()); }

std::string toml_text(const Moment& moment) {
    if (!moment.event) return toml_text(moment.offset);
    const std::string event = to_string(*moment.event);
    if (moment.offset == 0) return toml_text(event);
    return toml_text(
        fmt::format("{} {} {} s", event, moment.offset < 0 ? "-" : "+", std::abs(moment.offset)));
}

std::string toml_list(const std::vector<std::string>& items) {
    return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string toml_key(const std::string& name) {
    const bool bare =
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
        std::string::npos;
    return bare && !name.empty() ? name : toml_text(name);
}

}  // namespace hibi
