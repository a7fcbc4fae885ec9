// More methods on the same slices, for reports: Spencer's as a rigorous check, Ordinary
// (Fellenius). The search uses Bishop's.
// Facts of every reported surface; for polylines Spencer's factor is also what the descent
// minimises.
#pragma once

#include <optional>
#include <variant>

#include "lem_tool/bishop.hpp"
#include "lem_tool/slices.hpp"

namespace breach::lem {

/// The Ordinary method, without interslice forces.
struct Ordinary {
    /// With N' = (W - u b) cos a - H sin a, H without the water thrust: a slice under water has its
    /// buoyant weight (Turnbull & Hvorslev 1967), for any water depth [-].
    double factor_of_safety;
    /// With the usual N' = W cos a - H sin a - u l: it decreases with the depth of free water,
    /// unlike real slopes [-].
    double conventional;
};

/// None without a driving moment.
std::optional<Ordinary> ordinary(const Slices& slices, const scene::Circle& circle, Slide slide,
                                 double k_h);

struct Spencer {
    double factor_of_safety;  ///< [-]
    /// inclination of all interslice forces, downwards in the sliding direction [rad]
    double theta;
    /// minimum of cos(a - theta) + sin(a - theta) tan phi / F over slices with friction [-]
    double m_alpha;
};

/// No inclination of the interslice forces gives equilibrium of forces and moments; the nearest
/// one.
struct Unbalanced {
    double theta;         ///< [rad]
    double force_factor;  ///< F from force equilibrium there [-]; 0: no inclination has one
    double moment_left;   ///< residual over driving moment [-]; positive: drives
    /// no friction at all: F follows from moment equilibrium alone, for any theta
    bool without_friction;
};

/// What is known of similar surfaces. A descent fills it in from surface to surface.
struct Similar {
    /// Newton's method from an answer is several times faster than the whole search.
    std::optional<Spencer> answer;
    /// A failure takes the whole search. Where a surface has as much moment left over, it is not
    /// repeated.
    std::optional<Unbalanced> failure;
};

/// Spencer (1967): all interslice forces have the same inclination; the whole mass is in
/// equilibrium of forces and moments. Searches from -0.6 to 1.2 rad, with positive base forces
/// only. circle: reference of the slices' moments.
std::variant<Spencer, Unbalanced> spencer(const Slices& slices, const scene::Circle& circle,
                                          Slide slide, double k_h, const Similar& similar = {});

}  // namespace breach::lem
