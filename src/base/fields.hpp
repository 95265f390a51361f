#pragma once
#include <cereal/archives/binary.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/vec.hpp"

namespace cereal {

template <class Archive, int Rows>
void serialize(Archive& archive, Eigen::Matrix<double, Rows, 1>& vector) {
    archive(binary_data(vector.data(), sizeof(double) * Rows));
}

}  // namespace cereal

namespace hibi {

/// A struct with one list of its fields, `static void each_field(self, visit)`, which calls visit(name, field)
/// for each. What follows walks that list, so that a new field is one line.
template <class T>
concept HasFields = requires(T& value) { T::each_field(value, [](const char*, auto&) {}); };

template <class Archive, HasFields T>
void serialize(Archive& archive, T& value) {
    T::each_field(value, [&](const char*, auto& field) { archive(field); });
}

/// All fields, bit for bit. Only a program of the same version reads them.
template <HasFields T>
std::string to_bytes(const T& value) {
    std::ostringstream bytes;
    cereal::BinaryOutputArchive archive(bytes);
    archive(value);
    return std::move(bytes).str();
}

template <HasFields T>
void from_bytes(const std::string& bytes, T& value) {
    std::istringstream from(bytes);
    cereal::BinaryInputArchive archive(from);
    archive(value);
}

template <HasFields T>
std::string hash_of(const T& value) {
    return sha256(to_bytes(value));
}

/// Names of the fields that are not the same to the last bit.
template <HasFields T>
std::vector<std::string> differing_fields(const T& a, const T& b) {
    const auto bytes_of_fields = [](const T& value) {
        std::vector<std::pair<std::string, std::string>> fields;
        T::each_field(value, [&](const char* name, const auto& field) {
            std::ostringstream bytes;
            cereal::BinaryOutputArchive archive(bytes);
            archive(field);
            fields.emplace_back(name, std::move(bytes).str());
        });
        return fields;
    };
    const auto of_a = bytes_of_fields(a), of_b = bytes_of_fields(b);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < of_a.size(); ++k)
        if (of_a[k] != of_b[k]) names.push_back(of_a[k].first);
    return names;
}

}  // namespace hibi
