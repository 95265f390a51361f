#pragma once
#include <string>
#include <string_view>

namespace hibi {

/// Bytes as RFC 4648 base64, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace hibi
