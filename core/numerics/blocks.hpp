// Runs independent blocks of work on several threads. A block's result must not depend on its
// thread: then it is the same for any number of threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/numerics/team.hpp"

namespace breach::numerics {

/// Calls work(0) .. work(count - 1), each once. Rethrows the first exception.
template <class Work>
void run_blocks(std::size_t count, int threads, const Work& work) {
    Team(threads).share(count, work);
}

/// Divides [0, count) into one part per thread and calls part(begin, end, k), k below the number of
/// threads, each k once: part k may own scratch memory.
template <class Part>
void run_parts(std::size_t count, int threads, const Part& part) {
    const auto n = static_cast<std::size_t>(std::max(1, threads));
    run_blocks(n, threads, [&](std::size_t k) { part(count * k / n, count * (k + 1) / n, k); });
}

}  // namespace breach::numerics
