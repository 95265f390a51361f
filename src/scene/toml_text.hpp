#pragma once
#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

#include "base/field.hpp"
#include "results/moment.hpp"

namespace hibi {

// Values of a scene as TOML: SI, and the shortest text that reads back as the same value.
std::string toml_text(double value);
std::string toml_text(const std::string& text);
std::string toml_text(const Field& field);
std::string toml_text(const Vec<2>& point);
std::string toml_text(const Moment& moment);
template <std::integral T>
std::string toml_text(T value) {
    if constexpr (std::is_same_v<T, bool>)
        return value ? "true" : "false";
    else
        return std::to_string(value);
}
std::string toml_text(const char*) = delete;  // it would be taken for a flag

/// A list of texts that are TOML already.
std::string toml_list(const std::vector<std::string>& items);
template <class T>
std::string toml_text(const std::vector<T>& values) {
    std::vector<std::string> items;
    for (const T& value : values) items.push_back(toml_text(value));
    return toml_list(items);
}

/// A name as it stands in [material.NAME].
std::string toml_key(const std::string& name);

}  // namespace hibi
