// Independent blocks of work on several threads. The result of a block must not depend on the
// thread that runs it, so that it is the same for any number of threads.
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

/// Divides [0, count) into one part per thread: part(begin, end, k), with k below the number of
/// threads and each k once, so that part k may own scratch memory.
template <class Part>
void run_parts(std::size_t count, int threads, const Part& part) {
    const auto n = static_cast<std::size_t>(std::max(1, threads));
    run_blocks(n, threads, [&](std::size_t k) { part(count * k / n, count * (k + 1) / n, k); });
}

}  // namespace breach::numerics
