// Simplified Bishop: the factor of safety of a sliding mass in slices.
// For all arcs; the search calls it for each circle. Surfaces of straight pieces use Spencer's
// method.
#pragma once

#include "lem_tool/slices.hpp"

namespace breach::lem {

/// Direction of sliding; gives the sign of base inclinations.
enum class Slide { to_left, to_right };

/// Limit of m_alpha = cos a + sin a tan phi / F of slices with friction; without friction,
/// resistance does not depend on it (Whitman & Bailey 1967).
constexpr double least_m_alpha = 0.2;

enum class Balance {
    found,
    no_driving_moment,  ///< the weight does not drive the mass in this direction
    small_m_alpha,      ///< m_alpha of a slice is below the limit: the method is not valid
    not_converged,
};

struct Bishop {
    Balance balance;
    double factor_of_safety;  ///< for found or small_m_alpha [-]
    double m_alpha;           ///< minimum over the slices with friction, at most 1 [-]
    int iterations;
};

/// Direction in which the loads drive the mass.
Slide slide_of(const Slices& slices);

/// F = sum (c l cos a + (W - u l cos a) tan phi) / m_a / (sum of driving moments / R),
/// m_a = cos a + sin a tan phi / F   (Bishop 1955). k_h: horizontal over vertical acceleration,
/// towards the slide [-].
Bishop bishop(const Slices& slices, Slide slide, double k_h);

}  // namespace breach::lem
