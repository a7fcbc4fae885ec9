// The methods beside Bishop's, on the same slices: Spencer's as a rigorous check, Ordinary
// (Fellenius) as the oldest. Only for reporting; the search is Bishop's.
#pragma once

#include <optional>

#include "lem_tool/bishop.hpp"
#include "lem_tool/slices.hpp"

namespace breach::lem {

/// Interslice forces left out: N' = W cos a - H sin a - u l. None without a driving moment.
std::optional<double> ordinary(const Slices& slices, const scene::Circle& circle, Slide slide,
                               double k_h);

struct Spencer {
    double factor_of_safety;  ///< [-]
    double theta;  ///< inclination of all interslice forces, falling with the slope [rad]
};

/// Spencer (1967): all interslice forces have one inclination, forces and moments of the whole mass
/// balance. None where no inclination between -0.6 and 1.2 rad does that with positive bases.
std::optional<Spencer> spencer(const Slices& slices, const scene::Circle& circle, Slide slide,
                               double k_h);

}  // namespace breach::lem
