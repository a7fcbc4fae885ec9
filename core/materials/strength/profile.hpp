// Strength profile of a soil: peak and residual strength at a place, and the strains between the
// two. core/scene/ground.hpp gives the place; docs/reference/strengths.md says which phase uses
// what.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "core/materials/point.hpp"
#include "core/materials/strength/relations.hpp"

namespace breach::materials {

/// Quantities of the initial state on which strengths depend.
struct Place {
    double depth;      ///< below ground [m]
    double elevation;  ///< y [m]
    double sigma_v0;   ///< vertical effective stress [Pa], compression positive
};

enum class Along { depth, elevation, sigma_v0 };

/// Values along depth [m], elevation [m] or sigma'_v0 [Pa]: linear between the points, constant
/// beyond them.
struct Table {
    Along along = Along::depth;
    std::vector<std::array<double, 2>> points;  ///< ascending

    double at(const Place& place) const;
};

/// Constant c and phi: drained strength, or undrained with phi = 0.
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
    Table sounding;  ///< of the relation's sounding number
};

/// Strength as a function of place; undrained kinds have phi = 0.
struct StrengthCurve {
    std::variant<Effective, Undrained, Table, BySounding> kind;
    double least = 0.0;   ///< lower limit of s_u [Pa]
    double factor = 1.0;  ///< multiplies c and s_u, for parameter studies [-]
};
Strength strength_at(const StrengthCurve& curve, const Place& place);

inline bool is_undrained(const StrengthCurve& curve) {
    const auto* effective = std::get_if<Effective>(&curve.kind);
    return effective == nullptr || effective->phi == 0.0;
}
bool is_uniform(const StrengthCurve& curve);

/// Accumulated epsilon_q over which a point goes from peak to residual.
struct SofteningStrains {
    double start;
    double end;
    SofteningDriver driver;
};

struct StrengthProfile {
    StrengthCurve peak;
    std::optional<StrengthCurve> residual{};
    std::optional<SofteningStrains> softening{};  ///< requires a residual strength
};

/// Strength of a material point; without softening the residual equals the peak.
using PointStrength = StrengthOfPoint<double>;
/// before: softens from peak to residual if the profile has softening strains. liquefied: residual
/// strength from the start; the peak if there is none.
enum class Liquefaction { before, liquefied };
PointStrength strength_of_point(const StrengthProfile& profile, const Place& place,
                                Liquefaction liquefaction);

}  // namespace breach::materials
