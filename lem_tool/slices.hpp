// A sliding mass as vertical slices: geometry, weight and strength of each. arc.hpp and
// polyline.hpp cut surfaces into slices; no factor of safety here.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/mechanics/atmosphere.hpp"
#include "core/scene/scene.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// The end of a surface that is a vertical crack.
enum class CrackAt { none, left, right };

/// Strength of a region in limit equilibrium: c + coefficient (sigma'_v0 / p_a)^exponent.
struct Soil {
    enum class Passage {
        open,
        /// Closed: stronger than any surface (linear elastic)
        closed
    };
    double c;          ///< [Pa]
    double tan_phi;    ///< [-]
    double r_u = 0.0;  ///< u over the soil's vertical stress, where no water reaches [-]
    Passage passage = Passage::open;
    double coefficient = 0.0;           ///< undrained strength at sigma'_v0 = p_a [Pa]
    double exponent = 1.0;              ///< [-]
    std::optional<std::size_t> line{};  ///< whose water fills it, of Strata::lines; none: dry
    std::shared_ptr<const materials::StrengthCurve> profile{};      ///< s_u by place, instead of c
    std::shared_ptr<const materials::UndrainedByPlace> by_state{};  ///< the law's s_u, instead of c
    double factor = 1.0;                        ///< on the profile's s_u, or on that by state [-]
    std::shared_ptr<const Soil> above_water{};  ///< liquefied soil: its strength above its line
};

inline constexpr double p_a = mechanics::standard_atmosphere;  // [Pa]

/// Base of a slice: the arc, perpendicular to its radius, or a straight piece (a floor, a polyline)
/// that is not.
enum class Base { arc, straight };

/// Slices from left to right, one array per quantity; `resize`d once, then only `count` changes.
struct Slices {
    std::size_t count = 0;
    double depth = 0.0;               ///< greatest vertical depth of the mass [m]
    std::vector<double> left;         ///< x of the left side [m]
    std::vector<double> width;        ///< [m]
    std::vector<double> base;         ///< y of the base's middle [m]
    std::vector<double> sin_a;        ///< base inclination, positive when rising to the right [-]
    std::vector<double> cos_a;        ///< [-]
    std::vector<double> length;       ///< arc length of the base [m]
    std::vector<double> weight;       ///< soil, surcharge and free water above [N/m]
    std::vector<double> u;            ///< pore pressure at the base [Pa]
    std::vector<double> soil_weight;  ///< the soil's part of it [N/m]
    std::vector<double> push;  ///< horizontal load of free water and line loads, to the left [N/m]
    std::vector<double> water_push;  ///< the water's part of it [N/m]
    std::vector<Base> stands_on;
    std::vector<double>
        driving;  ///< what the loads turn, over R: on the arc their moment about the
                  ///< centre, on a straight base W h tan a and horizontal moments
                  ///< [N/m]
    std::vector<double> shaking;  ///< moment of the soil's weight, put horizontal, over R [N/m]
    std::vector<double> lever;  ///< arm of the base's shear in Bishop's moment over R: 1 on the arc
    /// (c l cos a + (W - u l cos a) tan phi) lever: Bishop's numerator [N/m]
    std::vector<double> force;
    std::vector<double> c;          ///< [Pa]
    std::vector<double> tan_phi;    ///< [-]
    std::vector<double> crossings;  ///< scratch of the cutting

    void reserve(std::size_t slices, std::size_t most_crossings);
    std::size_t capacity() const { return left.size(); }
};

/// Memory for `wanted` slices and every cut by the strata.
Slices make_slices(const Strata& strata, int wanted);

/// Why a surface cannot be analysed.
enum class Cut {
    done,
    above_ground,   ///< the arc leaves the soil between its ends
    leaves_model,   ///< the arc dips below the lowest boundary or reaches past the sides
    closed_region,  ///< the arc passes through a region that cannot fail
    overhangs,      ///< an end lies above the centre: the arc would lean back over the mass
};

}  // namespace breach::lem
