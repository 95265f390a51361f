#pragma once
#include <string>

namespace hibi {

/// JSON Schema (draft 7) of the scene file, for completion and checks while typing: every available block and
/// key with its meaning, unit, default and example. It is written from the table that the reader walks, and
/// accepts every scene that the reader accepts; what it cannot express (dimensions, selections, which keys
/// exclude each other) only the reader refuses.
std::string scene_schema();

}  // namespace hibi
