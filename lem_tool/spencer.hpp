// Further methods on the same slices: Spencer's as a rigorous check, Ordinary (Fellenius) as the
// oldest. Only for reports; the search uses Bishop's.
#pragma once

#include <optional>
#include <variant>

#include "lem_tool/bishop.hpp"
#include "lem_tool/slices.hpp"

namespace breach::lem {

/// The Ordinary method, without interslice forces.
struct Ordinary {
    /// With N' = (W - u b) cos a - H sin a, H without the water's thrust: a slice under water has
    /// its buoyant weight (Turnbull & Hvorslev 1967), at any depth of water [-].
    double factor_of_safety;
    /// With N' = W cos a - H sin a - u l, as Fellenius' method is mostly written: it falls with the
    /// depth of free water, as no real slope does [-].
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

/// No inclination of the interslice forces balances forces and moments: the nearest one.
struct Unbalanced {
    double theta;           ///< [rad]
    double force_factor;    ///< F that balances the forces there [-]; 0: no inclination has one
    double moment_left;     ///< residual over driving moment, signed; positive: it drives [-]
    bool without_friction;  ///< no slice has any: moment equilibrium alone gives F, for any theta
};

/// Spencer (1967): all interslice forces have one inclination; forces and moments of the whole mass
/// are in equilibrium. Searched between -0.6 and 1.2 rad, where all bases stay positive.
/// circle: what the slices' moments are about.
std::variant<Spencer, Unbalanced> spencer(const Slices& slices, const scene::Circle& circle,
                                          Slide slide, double k_h);

}  // namespace breach::lem
