// Points that fill the unit cube evenly, for samples. Both sequences keep their first points when
// more are requested.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace breach::statistics {

/// [points][dimensions], each 0 < u < 1.
using Points = std::vector<std::vector<double>>;

/// A nested Latin hypercube. The first `first` points, and the first 2, 4, 8, ... times as many, each
/// have exactly one point in each of so many equal slices of every dimension: a doubling cuts each
/// slice in two and puts a new point into the half that has none (as Sallaberry, Helton & Hora, Reliab.
/// Eng. Syst. Saf. 93, 2008, extend hypercubes). Between two doublings the slices are filled in part.
/// first >= 1.
Points latin_hypercube(std::size_t points, std::size_t first, std::size_t dimensions,
                       std::uint64_t seed);

/// Ends of the blocks in which a hypercube is made: first, 2 first, 4 first, ..., up to the first
/// that is not below `points`.
std::vector<std::size_t> blocks_of(std::size_t points, std::size_t first);

inline constexpr std::size_t most_sobol_dimensions = 64;

/// The Sobol sequence with the direction numbers new-joe-kuo-6 (Joe & Kuo 2008,
/// doi:10.1137/070709359; by Boost.Random), 32 bits, in Gray-code order from the origin:
/// [points][dimensions].
std::vector<std::vector<std::uint32_t>> sobol_sequence(std::size_t points, std::size_t dimensions);

/// The Sobol sequence with a digital shift from the seed (exclusive-or of each dimension with a
/// random number, which keeps it a digital net), moved to the middles of its 2^-32 steps.
Points sobol_points(std::size_t points, std::size_t dimensions, std::uint64_t seed);

}  // namespace breach::statistics
