#pragma once
#include <functional>
#include <string>
#include <utility>

#include "base/vec.hpp"

namespace hibi {

/// A scalar that a scene may let vary over the reference position X (m) and the time t (s). SI units.
/// A constant costs no call.
class Field {
 public:
    Field() = default;
    Field(double constant) : constant_(constant) {}
    /// text is what the scene wrote, kept so that the scene can be written back.
    Field(std::function<double(const Vec3& X, double t)> function, bool in_space, bool in_time,
          std::string text)
        : function_(std::move(function)), text_(std::move(text)), in_space_(in_space), in_time_(in_time) {}

    double operator()(const Vec3& X, double t) const { return function_ ? function_(X, t) : constant_; }
    bool varies_in_space() const { return in_space_; }
    bool varies_in_time() const { return in_time_; }
    bool is_constant() const { return !function_; }
    const std::string& text() const { return text_; }  ///< empty for a constant

 private:
    double constant_ = 0;
    std::function<double(const Vec3&, double)> function_;
    std::string text_;
    bool in_space_ = false, in_time_ = false;
};

}  // namespace hibi
