#pragma once
#include <span>

namespace hibi {

/// The fonts built into the program, whole OpenType files: the same pixels on every machine, whatever is
/// installed. Inter 4 (SIL Open Font License 1.1) and IPAex Gothic (IPA Font License 1.0).
std::span<const unsigned char> inter_regular();
std::span<const unsigned char> inter_semibold();
std::span<const unsigned char> ipaex_gothic();

}  // namespace hibi
