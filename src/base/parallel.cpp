#include "base/parallel.hpp"

#include <omp.h>

namespace hibi {

namespace {
int thread_count = 0;
}

int threads() { return thread_count > 0 ? thread_count : omp_get_num_procs(); }
void set_threads(int count) { thread_count = count; }

}  // namespace hibi
