// Independent work shared among threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace breach::transfer {

/// Work on [0, count) in one part per thread: part(begin, end, thread). Thread 0 is the caller's.
template <typename Part>
void share(std::size_t count, int threads, Part part) {
    const auto n = static_cast<std::size_t>(std::max(1, threads));
    std::vector<std::jthread> workers;
    for (std::size_t t = 1; t < n; ++t)
        workers.emplace_back([=] { part(count * t / n, count * (t + 1) / n, t); });
    part(std::size_t{0}, count / n, std::size_t{0});
}

}  // namespace breach::transfer
