#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cassert>

#include "core/statistics/points.hpp"
#include "core/statistics/random.hpp"

namespace breach::statistics {

std::vector<std::vector<std::uint32_t>> sobol_sequence(std::size_t points, std::size_t dimensions) {
    assert(dimensions <= most_sobol_dimensions);
    std::vector<std::vector<std::uint32_t>> sequence(points,
                                                     std::vector<std::uint32_t>(dimensions, 0));
    if (dimensions == 0) return sequence;
    boost::random::sobol_engine<std::uint32_t, 32> engine(dimensions);  // without the first point
    for (std::size_t i = 1; i < points; ++i)
        std::ranges::generate(sequence[i], [&] { return engine(); });
    return sequence;
}

Points sobol_points(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
    const auto sequence = sobol_sequence(points, dimensions);
    Points placed(points, std::vector<double>(dimensions));
    for (std::size_t d = 0; d < dimensions; ++d) {
        const auto shift = static_cast<std::uint32_t>(Random(seed, d).bits());
        for (std::size_t i = 0; i < points; ++i)
            placed[i][d] = (static_cast<double>(sequence[i][d] ^ shift) + 0.5) * 0x1p-32;
    }
    return placed;
}

}  // namespace breach::statistics
