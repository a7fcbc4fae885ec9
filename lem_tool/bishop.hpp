// Simplified Bishop: the factor of safety of one sliding mass that is already cut into slices.
#pragma once

#include "lem_tool/slices.hpp"

namespace breach::lem {

/// The way the mass moves; it decides the sign of the base inclinations.
enum class Slide { to_left, to_right };

enum class Balance {
    found,
    no_driving_moment,  ///< the weight does not turn the mass this way
    small_m_alpha,      ///< m_alpha below least_m_alpha on a frictional slice: the method does not
                        ///< apply
    not_converged,
};

/// Whitman & Bailey (1967): below this, the normal force on a base that rises against the slide is
/// a figure of the method, not of the soil. phi = 0 slices have no such limit, their resistance
/// does not depend on the normal force.
inline constexpr double least_m_alpha = 0.2;

struct Bishop {
    Balance balance;
    double factor_of_safety;  ///< meaningful when found or small_m_alpha [-]
    double m_alpha;           ///< least over frictional slices, 1 if there is none [-]
    int iterations;
};

/// The direction in which the loads turn the mass.
Slide slide_of(const Slices& slices);

/// F = sum (c l cos a + (W - u l cos a) tan phi) / m_a / (sum of driving moments / R),
/// m_a = cos a + sin a tan phi / F   (Bishop 1955). k_h: horizontal over vertical acceleration,
/// towards the slide [-].
Bishop bishop(const Slices& slices, Slide slide, double k_h);

}  // namespace breach::lem
