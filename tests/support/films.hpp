#pragma once

namespace hibi::test {

/// Blocks of a scene whose film is not looked at, only made.
inline constexpr const char* small_film = R"(
[view]
size = [160, 120]
[movie]
duration = "0.5 s"
fps = 10
)";

}  // namespace hibi::test
