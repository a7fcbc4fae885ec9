// Samples that fill the unit cube evenly. Both sequences keep their first points if extended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace breach::statistics {

/// [points][dimensions], 0 < u < 1.
using Points = std::vector<std::vector<double>>;

/// A nested Latin hypercube. The first `first` points, and the first 2, 4, 8, ... times as many,
/// have exactly one point in each of as many equal slices of every dimension. A doubling halves
/// each slice and puts a new point into the empty half (extension as by Sallaberry, Helton & Hora,
/// Reliab. Eng. Syst. Saf. 93, 2008). Between doublings only some slices are filled. first >= 1.
Points latin_hypercube(std::size_t points, std::size_t first, std::size_t dimensions,
                       std::uint64_t seed);

/// Ends of the blocks of a hypercube: first, 2 first, 4 first, ..., up to the first that is not
/// below `points`.
std::vector<std::size_t> blocks_of(std::size_t points, std::size_t first);

inline constexpr std::size_t most_sobol_dimensions = 64;

/// Sobol sequence with the direction numbers new-joe-kuo-6 (Joe & Kuo 2008, doi:10.1137/070709359;
/// by Boost.Random), 32 bits, in Gray-code order from the origin: [points][dimensions].
std::vector<std::vector<std::uint32_t>> sobol_sequence(std::size_t points, std::size_t dimensions);

/// Sobol sequence with a random digital shift (exclusive-or in each dimension, which keeps it a
/// digital net), moved to the middles of its 2^-32 steps.
Points sobol_points(std::size_t points, std::size_t dimensions, std::uint64_t seed);

}  // namespace breach::statistics
