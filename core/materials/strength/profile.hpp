// The strength of one soil, written once: its value at a place before failure (peak) and after it
// (residual), and the strains between the two. Pure numbers; core/scene finds the place
// (ground.hpp), and docs/reference/strengths.md says which phase uses what.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "core/materials/point.hpp"
#include "core/materials/strength/relations.hpp"

namespace breach::materials {

/// Quantities that strengths depend on, in the initial state.
struct Place {
    double depth;      ///< below ground [m]
    double elevation;  ///< y [m]
    double sigma_v0;   ///< vertical effective stress [Pa], compression positive
};

enum class Along { depth, elevation, sigma_v0 };

/// Numbers along depth [m], elevation [m] or sigma'_v0 [Pa]: straight between its points, held
/// beyond its ends. One point: the same everywhere.
struct Table {
    Along along = Along::depth;
    std::vector<std::array<double, 2>> points;  ///< ascending

    double at(const Place& place) const;
};

/// Drained, or undrained with phi = 0, the same at every place.
struct Effective {
    double c;    ///< [Pa]
    double phi;  ///< [rad]
};

/// s_u = constant + per_metre depth + coefficient (sigma'_v0 / p_a)^exponent.
struct Undrained {
    double constant = 0.0;     ///< [Pa]
    double per_metre = 0.0;    ///< [Pa/m]
    double coefficient = 0.0;  ///< [Pa]
    double exponent = 1.0;     ///< [-]
};

struct BySounding {
    Relation relation;
    Table sounding;  ///< of the number that the relation asks for
};

/// One strength by place; undrained kinds have phi = 0.
struct StrengthCurve {
    std::variant<Effective, Undrained, Table, BySounding> kind;
    double least = 0.0;   ///< of s_u [Pa]
    double factor = 1.0;  ///< on c and s_u: for studies to vary [-]
};
Strength strength_at(const StrengthCurve& curve, const Place& place);

inline bool is_undrained(const StrengthCurve& curve) {
    const auto* effective = std::get_if<Effective>(&curve.kind);
    return effective == nullptr || effective->phi == 0.0;
}
/// Whether it is the same at every place.
bool is_uniform(const StrengthCurve& curve);
/// Whether it depends on sigma'_v0.
bool needs_stress(const StrengthCurve& curve);

/// Accumulated epsilon_q over which a point goes from peak to residual.
struct SofteningStrains {
    double start;
    double end;
    SofteningDriver driver;
};

struct StrengthProfile {
    StrengthCurve peak;
    std::optional<StrengthCurve> residual{};
    std::optional<SofteningStrains> softening{};  ///< only with a residual
};

/// The strength that a material point keeps; the residual is the peak where it does not soften.
using PointStrength = StrengthOfPoint<double>;
/// before: softens from peak to residual, if the profile has strains for it. liquefied: has the
/// residual strength from the start; without a residual, the peak.
enum class Liquefaction { before, liquefied };
PointStrength strength_of_point(const StrengthProfile& profile, const Place& place,
                                Liquefaction liquefaction);

}  // namespace breach::materials
