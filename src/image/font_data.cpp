#include "image/font_data.hpp"

// The assembler copies the files in; HIBI_FONT_... are their paths, set in CMakeLists.txt.
#define HIBI_EMBED(name, file)                                       \
    __asm__(                                                         \
        ".pushsection .rodata\n"                                     \
        ".balign 16\n" #name "_begin:\n.incbin \"" file "\"\n" #name \
        "_end:\n"                                                    \
        ".popsection\n");                                            \
    extern "C" const unsigned char name##_begin[], name##_end[]

HIBI_EMBED(hibi_inter_regular, HIBI_FONT_REGULAR);
HIBI_EMBED(hibi_inter_semibold, HIBI_FONT_SEMIBOLD);
HIBI_EMBED(hibi_ipaex_gothic, HIBI_FONT_JAPANESE);

namespace hibi {

std::span<const unsigned char> inter_regular() { return {hibi_inter_regular_begin, hibi_inter_regular_end}; }
std::span<const unsigned char> inter_semibold() {
    return {hibi_inter_semibold_begin, hibi_inter_semibold_end};
}
std::span<const unsigned char> ipaex_gothic() { return {hibi_ipaex_gothic_begin, hibi_ipaex_gothic_end}; }

}  // namespace hibi
