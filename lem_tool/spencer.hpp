// The methods beside Bishop's, on the same slices: Spencer's as a rigorous check, Ordinary
// (Fellenius) as the oldest. Only for reporting; the search is Bishop's.
#pragma once

#include <optional>
#include <variant>

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

/// No one inclination of the interslice forces balances forces and moments: what comes nearest.
struct Unbalanced {
    double theta;           ///< [rad]
    double force_factor;    ///< F that balances the forces there [-]; 0: no inclination has one
    double moment_left;     ///< over the driving moment, with its sign; positive: it drives [-]
    bool without_friction;  ///< no slice has any: the moments alone have one F, whatever theta
};

/// Spencer (1967): all interslice forces have one inclination, forces and moments of the whole mass
/// balance. Looked for between -0.6 and 1.2 rad, where all bases stay positive.
/// circle: what the slices' moments are about.
std::variant<Spencer, Unbalanced> spencer(const Slices& slices, const scene::Circle& circle,
                                          Slide slide, double k_h);

}  // namespace breach::lem
