// Elements or points in ranges of a fixed length, on several threads: each range writes to
// places of its own, so that no result depends on the number of threads. The caller sums up in
// order.
#pragma once

#include <algorithm>

#include "core/numerics/team.hpp"

namespace breach::fem {

/// Calls range(begin, end) until [0, count) is covered, each place once; at once on one thread.
template <class Range>
void for_ranges(std::size_t count, numerics::Team& team, const Range& range) {
    constexpr std::size_t length = 256;  // some 0.1 ms of work
    if (team.threads() == 1 || count <= length) return range(std::size_t{0}, count);
    const auto one = [&](std::size_t k) { range(k * length, std::min(count, (k + 1) * length)); };
    team.share((count + length - 1) / length, one);
}

}  // namespace breach::fem
