// Independent blocks of work on some threads. What a block computes may not depend on which thread
// runs it, so the answer is the same on one thread and on many.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/numerics/team.hpp"

namespace breach::numerics {

/// Calls work(0) .. work(count - 1), each once. The first exception is thrown again here.
template <class Work>
void run_blocks(std::size_t count, int threads, const Work& work) {
    Team(threads).share(count, work);
}

/// Cuts [0, count) into one part per thread: part(begin, end, k), k below the number of threads and
/// each k once, so that it may own scratch memory.
template <class Part>
void run_parts(std::size_t count, int threads, const Part& part) {
    const auto n = static_cast<std::size_t>(std::max(1, threads));
    run_blocks(n, threads, [&](std::size_t k) { part(count * k / n, count * (k + 1) / n, k); });
}

}  // namespace breach::numerics
