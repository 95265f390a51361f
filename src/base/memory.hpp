#pragma once

namespace hibi {

/// Makes the program keep the memory that it frees, for what comes next, and take it in large pages. A page
/// that the system hands out anew is cleared first, and a large run would ask for many thousands every
/// second: each state, each frame. To be called once, at the start. Does nothing, and returns false, where
/// this is not glibc, under a sanitizer, where the size of programs is limited, or where the system promises
/// no more memory than it has.
bool keep_freed_memory();

}  // namespace hibi
