#pragma once
#include <string>
#include <string_view>

namespace hibi {

/// Code points of UTF-8 text. Overlong forms, surrogates and stray bytes are refused (std::runtime_error
/// naming the byte).
std::u32string decode_utf8(const std::string& text);
std::string encode_utf8(std::u32string_view points);

}  // namespace hibi
