// Properties of a law for other folders. Every law implements them in its own header. Other folders
// query the Law (law.hpp) and never test which law it is.
#pragma once

#include <concepts>
#include <optional>
#include <variant>

#include "core/materials/law_lanes.hpp"
#include "core/materials/point.hpp"

namespace breach::materials {

struct Traits {
    const char* type;  ///< value of /materials/*/law/type
    const char* name;  ///< for display
    bool yields;       ///< has plastic flow
    bool opens;       ///< opens cracks in tension, which must close before pressure builds up again
    bool frictional;  ///< its strength depends on the effective stress
    bool c_and_phi;   ///< its strength has the two entries c and phi; see strength_entries
    bool symmetric_tangent;  ///< the tangent for statics near collapse is symmetric
    /// distinguishes plastic from elastic strain; if not, all strain counts
    bool tells_plastic_strain;
};

/// Pointers to a law's strength parameters; null if it has none.
struct StrengthEntries {
    double* c = nullptr;    ///< [Pa]
    double* phi = nullptr;  ///< [rad]
    double* psi = nullptr;  ///< dilatancy angle [rad]
};

template <class... Each>
std::variant<Each...> variant_of(LawList<Each...>);
/// A law for the MPM's loops; the variant index is its index in the list.
using LawLanes = decltype(variant_of(LaneLaws{}));

template <class Law>
concept Answers = requires(const Law& law, Law& own, const State& state) {
    /// Isotropic elasticity inside the yield surface, and of elastic stages.
    { law.elasticity } -> std::convertible_to<mechanics::Elasticity>;
    { traits(law) } -> std::same_as<Traits>;
    /// Peak strength for limit equilibrium; none: the law does not fail.
    { limit_strength(law) } -> std::same_as<std::optional<Strength>>;
    /// Null: no softening.
    { softening(law) } -> std::same_as<const Softening*>;
    { strength_entries(own) } -> std::same_as<StrengthEntries>;
    /// How far the stress lies outside the yield surface at this epsilon_q [Pa]; <= 0 inside. Minus
    /// infinity if the law accepts any stress.
    { yield_excess(law, state) } -> std::same_as<double>;
    /// A stress outside the yield surface, returned to it by the law's own return mapping.
    { return_to_surface(law, state) } -> std::same_as<Voigt>;
    /// The law for the MPM's loops; none: not for material points.
    { for_particles(law) } -> std::same_as<std::optional<LawLanes>>;
    /// Constants of the law for all points: computed before a loop and passed to `integrate`.
    ready(law);
};

}  // namespace breach::materials
