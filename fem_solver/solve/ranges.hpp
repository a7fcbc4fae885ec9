// Runs ranges of elements or points of constant length on several threads. Each range writes only
// to its own entries, and the caller sums in order: results do not depend on the number of threads.
#pragma once

#include <algorithm>

#include "core/numerics/team.hpp"

namespace breach::fem {

/// Calls range(begin, end) until [0, count) is covered once; as one range on a single thread.
template <class Range>
void for_ranges(std::size_t count, numerics::Team& team, const Range& range) {
    constexpr std::size_t length = 256;  // about 0.1 ms of work
    if (team.threads() == 1 || count <= length) return range(std::size_t{0}, count);
    const auto one = [&](std::size_t k) { range(k * length, std::min(count, (k + 1) * length)); };
    team.share((count + length - 1) / length, one);
}

}  // namespace breach::fem
