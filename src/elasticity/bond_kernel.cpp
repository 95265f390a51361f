#include "elasticity/bond_kernel.hpp"

#include <cstdlib>
#include <cstring>

namespace hibi::kernel {

#if defined(__x86_64__)

namespace v2 {
extern const Loops loops;
}
namespace v3 {
extern const Loops loops;
}
namespace v4 {
extern const Loops loops;
}

namespace {

/// 2, 3 or 4.
int processor_level() {
    const int has = __builtin_cpu_supports("x86-64-v4") ? 4 : __builtin_cpu_supports("x86-64-v3") ? 3 : 2;
    const char* asked = std::getenv("HIBI_CPU_LEVEL");
    for (int level = 2; asked && level < has; ++level)
        if (std::strcmp(asked, level == 2 ? "v2" : "v3") == 0) return level;
    return has;
}

}  // namespace

const Loops& loops() {
    switch (processor_level()) {
        case 4:
            return v4::loops;
        case 3:
            return v3::loops;
        default:
            return v2::loops;
    }
}

#else

namespace generic {
extern const Loops loops;
}
const Loops& loops() { return generic::loops; }

#endif

}  // namespace hibi::kernel
