#include <array>
#include <bit>
#include <cassert>

#include "core/statistics/points.hpp"
#include "core/statistics/random.hpp"

namespace breach::statistics {

namespace {

constexpr std::size_t bits = 32;
constexpr std::size_t highest_degree = 9;

/// Of one dimension: the degree of its primitive polynomial, the polynomial's inner coefficients as
/// bits, and the first direction numbers m.
struct JoeKuo {
    std::size_t degree;
    std::uint32_t coefficients;
    std::array<std::uint32_t, highest_degree> m;
};

/// Dimensions 2 to 64 of new-joe-kuo-6 (S. Joe & F. Y. Kuo, SIAM J. Sci. Comput. 30, 2635-2654, 2008).
constexpr std::array<JoeKuo, most_sobol_dimensions - 1> joe_kuo{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
    {7, 7, {1, 1, 3, 13, 7, 35, 63}},
    {7, 8, {1, 3, 5, 9, 1, 25, 53}},
    {7, 14, {1, 3, 1, 13, 9, 35, 107}},
    {7, 19, {1, 3, 1, 5, 27, 61, 31}},
    {7, 21, {1, 1, 5, 11, 19, 41, 61}},
    {7, 28, {1, 3, 5, 3, 3, 13, 69}},
    {7, 31, {1, 1, 7, 13, 1, 19, 1}},
    {7, 32, {1, 3, 7, 5, 13, 19, 59}},
    {7, 37, {1, 1, 3, 9, 25, 29, 41}},
    {7, 41, {1, 3, 5, 13, 23, 1, 55}},
    {7, 42, {1, 3, 7, 3, 13, 59, 17}},
    {7, 50, {1, 3, 1, 3, 5, 53, 69}},
    {7, 55, {1, 1, 5, 5, 23, 33, 13}},
    {7, 56, {1, 1, 7, 7, 1, 61, 123}},
    {7, 59, {1, 1, 7, 9, 13, 61, 49}},
    {7, 62, {1, 3, 3, 5, 3, 55, 33}},
    {8, 14, {1, 3, 1, 15, 31, 13, 49, 245}},
    {8, 21, {1, 3, 5, 15, 31, 59, 63, 97}},
    {8, 22, {1, 3, 1, 11, 11, 11, 77, 249}},
    {8, 38, {1, 3, 1, 11, 27, 43, 71, 9}},
    {8, 47, {1, 1, 7, 15, 21, 11, 81, 45}},
    {8, 49, {1, 3, 7, 3, 25, 31, 65, 79}},
    {8, 50, {1, 3, 1, 1, 19, 11, 3, 205}},
    {8, 52, {1, 1, 5, 9, 19, 21, 29, 157}},
    {8, 56, {1, 3, 7, 11, 1, 33, 89, 185}},
    {8, 67, {1, 3, 3, 3, 15, 9, 79, 71}},
    {8, 70, {1, 3, 7, 11, 15, 39, 119, 27}},
    {8, 84, {1, 1, 3, 1, 11, 31, 97, 225}},
    {8, 97, {1, 1, 1, 3, 23, 43, 57, 177}},
    {8, 103, {1, 3, 7, 7, 17, 17, 37, 71}},
    {8, 115, {1, 3, 1, 5, 27, 63, 123, 213}},
    {8, 122, {1, 1, 3, 5, 11, 43, 53, 133}},
    {9, 8, {1, 3, 5, 5, 29, 17, 47, 173, 479}},
    {9, 13, {1, 3, 3, 11, 3, 1, 109, 9, 69}},
    {9, 16, {1, 1, 1, 5, 17, 39, 23, 5, 343}},
    {9, 22, {1, 3, 1, 5, 25, 15, 31, 103, 499}},
    {9, 25, {1, 1, 1, 11, 11, 17, 63, 105, 183}},
    {9, 44, {1, 1, 5, 11, 9, 29, 97, 231, 363}},
    {9, 47, {1, 1, 5, 15, 19, 45, 41, 7, 383}},
    {9, 52, {1, 3, 7, 7, 31, 19, 83, 137, 221}},
    {9, 55, {1, 1, 1, 3, 23, 15, 111, 223, 83}},
    {9, 59, {1, 1, 5, 13, 31, 15, 55, 25, 161}},
    {9, 62, {1, 1, 3, 13, 25, 47, 39, 87, 257}},
}};

using Directions = std::array<std::uint32_t, bits>;

/// The first dimension is van der Corput's.
Directions directions_of(std::size_t dimension) {
    Directions v{};
    if (dimension == 0) {
        for (std::size_t i = 0; i < bits; ++i) v[i] = 1U << (bits - 1 - i);
        return v;
    }
    const JoeKuo& row = joe_kuo[dimension - 1];
    const std::size_t s = row.degree;
    for (std::size_t i = 0; i < bits; ++i) {
        if (i < s) {
            v[i] = row.m[i] << (bits - 1 - i);
            continue;
        }
        v[i] = v[i - s] ^ (v[i - s] >> s);
        for (std::size_t k = 1; k < s; ++k)
            if (((row.coefficients >> (s - 1 - k)) & 1U) != 0) v[i] ^= v[i - k];
    }
    return v;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> sobol_sequence(std::size_t points, std::size_t dimensions) {
    assert(dimensions <= most_sobol_dimensions);
    std::vector<std::vector<std::uint32_t>> sequence(points,
                                                     std::vector<std::uint32_t>(dimensions, 0));
    for (std::size_t d = 0; d < dimensions; ++d) {
        const Directions v = directions_of(d);
        for (std::size_t i = 1; i < points; ++i)
            sequence[i][d] =
                sequence[i - 1][d] ^ v[static_cast<std::size_t>(std::countr_one(i - 1))];
    }
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
