// Properties of a law for other folders. Every law of the list in law.hpp implements them in its
// own header, or it does not compile. Other folders query the Law (law.hpp) and never test which
// law it is.
#pragma once

#include <concepts>
#include <optional>
#include <variant>

#include "core/materials/law_lanes.hpp"
#include "core/materials/point.hpp"

namespace breach::materials {

struct Traits {
    const char* type;  ///< the scene's word for it, /materials/*/law/type
    const char* name;  ///< for people
    bool yields;       ///< has plastic flow
    bool opens;        ///< opens in tension: that volume must close before pressure builds again
    bool frictional;   ///< its strength depends on the effective stress
    bool c_and_phi;    ///< its strength is given by two entries; see strength_entries
    bool symmetric_tangent;     ///< the tangent that statics near collapse needs is symmetric
    bool tells_plastic_strain;  ///< knows which part of a strain is plastic; else all of it counts
};

/// Where a law's strength can be changed; null where it has no such entry.
struct StrengthEntries {
    double* c = nullptr;    ///< [Pa]
    double* phi = nullptr;  ///< [rad]
};

template <class... Each>
std::variant<Each...> variant_of(LawList<Each...>);
/// A law made ready for the MPM's loops; its place in the list is its index.
using LawLanes = decltype(variant_of(LaneLaws{}));

/// The interface.
template <class Law>
concept Answers = requires(const Law& law, Law& own, const State& state) {
    /// Isotropic elasticity inside the yield surface, or before the law begins.
    { law.elasticity } -> std::convertible_to<mechanics::Elasticity>;
    { traits(law) } -> std::same_as<Traits>;
    /// Peak strength at failure for limit equilibrium; nothing: it cannot fail.
    { limit_strength(law) } -> std::same_as<std::optional<Strength>>;
    /// How it softens; null: it does not.
    { softening(law) } -> std::same_as<const Softening*>;
    { strength_entries(own) } -> std::same_as<StrengthEntries>;
    /// Amount by which the stress lies outside the yield surface at this epsilon_q [Pa]; <= 0
    /// inside. Minus infinity if the law accepts any stress from elsewhere.
    { yield_excess(law, state) } -> std::same_as<double>;
    /// The stress put back on the yield surface by the law's own return, where it lies outside.
    { return_to_surface(law, state) } -> std::same_as<Voigt>;
    /// The law for the MPM's loops; none: particles cannot have it.
    { for_particles(law) } -> std::same_as<std::optional<LawLanes>>;
    /// The law with everything resolved that is the same for all points: made before a loop, and
    /// passed to `integrate` inside it.
    ready(law);
};

}  // namespace breach::materials
