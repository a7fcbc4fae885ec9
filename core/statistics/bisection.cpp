#include "core/statistics/bisection.hpp"

#include <algorithm>
#include <cassert>

namespace breach::statistics {

namespace {

using Runouts = std::span<const std::optional<double>>;

std::vector<std::size_t> missing_seeds(std::size_t count, Runouts runouts, int seeds) {
    std::vector<std::size_t> missing;
    const auto wanted = std::min<std::size_t>(std::max(seeds, 2), count);
    for (std::size_t i = 0; i < wanted; ++i) {
        const std::size_t at =
            wanted == 1 ? 0 : (i * (count - 1) + (wanted - 1) / 2) / (wanted - 1);
        if (!runouts[at]) missing.push_back(at);
    }
    return missing;
}

struct Search {
    std::size_t on;
    std::optional<std::size_t> off;
    std::optional<std::size_t> halve;  ///< between the two, not run yet
};

/// Walks from the largest runout outwards through the known runouts.
Search edge_from(std::size_t top, int direction, Runouts runouts, double level) {
    Search edge{top, std::nullopt, std::nullopt};
    const auto count = static_cast<std::ptrdiff_t>(runouts.size());
    for (auto i = static_cast<std::ptrdiff_t>(top) + direction; i >= 0 && i < count;
         i += direction) {
        const auto& runout = runouts[static_cast<std::size_t>(i)];
        if (!runout) continue;
        if (*runout < level) {
            edge.off = static_cast<std::size_t>(i);
            break;
        }
        edge.on = static_cast<std::size_t>(i);
    }
    if (edge.off) {
        const std::size_t middle = (edge.on + *edge.off) / 2;
        if (middle != edge.on && middle != *edge.off) edge.halve = middle;
    }
    return edge;
}

}  // namespace

Advice advise(std::span<const double> times, Runouts runouts, double share, int seeds) {
    assert(times.size() == runouts.size());
    Advice advice;
    if (times.empty()) return advice;
    advice.run_next = missing_seeds(times.size(), runouts, seeds);
    if (!advice.run_next.empty()) return advice;
    std::size_t top = 0;
    for (std::size_t i = 0; i < runouts.size(); ++i) {
        if (runouts[i].value_or(no_runout) > runouts[top].value_or(no_runout)) top = i;
    }
    const double largest = *runouts[top];
    if (largest <= 0.0) return advice;
    const Search lower = edge_from(top, -1, runouts, share * largest);
    const Search upper = edge_from(top, +1, runouts, share * largest);
    const auto edge = [&](const Search& found) {
        Edge made{std::nullopt, times[found.on]};
        if (found.off) made.off = times[*found.off];
        return made;
    };
    advice.plateau = Plateau{edge(lower), edge(upper), largest, times[top]};
    for (const Search& each : {lower, upper}) {
        if (each.halve) advice.run_next.push_back(*each.halve);
    }
    return advice;
}

}  // namespace breach::statistics
