#pragma once
#include <span>

namespace hibi {

struct BuiltInFont {
    const char* name;
    std::span<const unsigned char> bytes;  ///< a whole OpenType file
};

/// The fonts built into the program: the same pixels on every machine, whatever is installed there. The first
/// is Inter, the second its semi-bold, the third IPAex Gothic; the others, one weight each, follow in the
/// order in which they are asked for what those lack. Listed in CMakeLists.txt.
std::span<const BuiltInFont> built_in_fonts();

}  // namespace hibi
