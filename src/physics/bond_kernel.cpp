#include "physics/bond_kernel.hpp"

#include <cstdlib>
#include <cstring>

namespace hibi::kernel {

namespace {
bool reproducible = false;
}

void require_reproducible_loops(bool required) { reproducible = required; }

#if defined(__x86_64__)

namespace v2 { extern const Loops loops; }
namespace v3 { extern const Loops loops; }
namespace v3_fused { extern const Loops loops; }
namespace v4 { extern const Loops loops; }
namespace v4_fused { extern const Loops loops; }

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
        case 4: return reproducible ? v4::loops : v4_fused::loops;
        case 3: return reproducible ? v3::loops : v3_fused::loops;
        default: return v2::loops;  // has no fused multiply-add
    }
}

#else

namespace generic { extern const Loops loops; }
namespace generic_fused { extern const Loops loops; }
const Loops& loops() { return reproducible ? generic::loops : generic_fused::loops; }

#endif

}  // namespace hibi::kernel
