// The methods beside Bishop's, on the same slices: Spencer's as a rigorous check, Ordinary
// (Fellenius) as the oldest. Only for reporting; the search is Bishop's.
#pragma once

#include <optional>

#include "lem_tool/bishop.hpp"
#include "lem_tool/slices.hpp"

namespace breach::lem {

/// Interslice forces left out.
struct Ordinary {
    /// With N' = (W - u b) cos a - H sin a, H without the water's thrust: the slice under water is
    /// its buoyant weight (Turnbull & Hvorslev 1967), however deep the water [-].
    double factor_of_safety;
    /// With N' = W cos a - H sin a - u l, as Fellenius' method is mostly written: it falls with the
    /// depth of free water, which no slope does [-].
    double conventional;
};

/// None without a driving moment.
std::optional<Ordinary> ordinary(const Slices& slices, const scene::Circle& circle, Slide slide,
                                 double k_h);

struct Spencer {
    double factor_of_safety;  ///< [-]
    double theta;    ///< inclination of all interslice forces, falling with the slope [rad]
    double m_alpha;  ///< least cos(a - theta) + sin(a - theta) tan phi / F of frictional slices [-]
};

/// Spencer (1967): all interslice forces have one inclination, forces and moments of the whole mass
/// balance. None where no inclination between -0.6 and 1.2 rad does that with positive bases.
/// circle: what the slices' moments are about.
std::optional<Spencer> spencer(const Slices& slices, const scene::Circle& circle, Slide slide,
                               double k_h);

}  // namespace breach::lem
