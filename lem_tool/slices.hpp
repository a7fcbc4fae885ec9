// A sliding mass as vertical slices: geometry, weight and strength. arc.hpp and polyline.hpp cut
// surfaces into slices.
// One Slices per thread is filled again and again; all methods read the same arrays.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/mechanics/atmosphere.hpp"
#include "core/scene/scene.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// The end of a surface at a vertical crack.
enum class CrackAt { none, left, right };

class SnapshotStrength;

/// Strength of a region in limit equilibrium: c + coefficient (sigma'_v0 / p_a)^exponent.
struct Soil {
    enum class Passage {
        open,
        /// cannot fail (linear elastic)
        closed
    };
    double c;          ///< [Pa]
    double tan_phi;    ///< [-]
    double r_u = 0.0;  ///< u over the soil's vertical stress, if it has no water line [-]
    Passage passage = Passage::open;
    double coefficient = 0.0;           ///< undrained strength at sigma'_v0 = p_a [Pa]
    double exponent = 1.0;              ///< [-]
    std::optional<std::size_t> line{};  ///< index into Strata::lines; none: dry
    std::shared_ptr<const materials::StrengthCurve> profile{};      ///< s_u by place, replaces c
    std::shared_ptr<const materials::UndrainedByPlace> by_state{};  ///< s_u by the law, replaces c
    double factor = 1.0;  ///< multiplies s_u of profile or law [-]
    std::shared_ptr<const SnapshotStrength> of_snapshot{};  ///< within its mesh replaces all these
    std::shared_ptr<const Soil> above_water{};  ///< liquefied soil: strength above its water line
};

inline constexpr double p_a = mechanics::standard_atmosphere;  // [Pa]

/// Base of a slice: the arc, normal to its radius, or a straight piece (floor, polyline).
enum class Base { arc, straight };

/// Slices from left to right, one array per quantity; allocated once, `count` are valid.
/// Signs are those of a slide to the left: driving and push are positive to the left, sin_a for a
/// base that rises to the right. Methods multiply by -1 for a slide to the right. `shaking` has no
/// sign: it acts towards the slide.
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
    std::vector<double> soil_weight;  ///< part of the soil [N/m]
    std::vector<double> push;         ///< horizontal load of free water, to the left [N/m]
    std::vector<Base> stands_on;
    std::vector<double>
        /// driving moment over R: of the loads about the centre; on a straight base W h tan a and
        /// horizontal moments [N/m]
        driving;
    /// moment of the soil's weight applied horizontally, over R [N/m]
    std::vector<double> shaking;
    /// lever arm of the base shear in Bishop's moment, over R: 1 on the arc [-]
    std::vector<double> lever;
    /// (c l cos a + (W - u l cos a) tan phi) lever: Bishop's numerator [N/m]
    std::vector<double> force;
    std::vector<double> c;          ///< [Pa]
    std::vector<double> tan_phi;    ///< [-]
    std::vector<double> crossings;  ///< scratch memory of the cutting

    void reserve(std::size_t slices, std::size_t most_crossings);
    std::size_t capacity() const { return left.size(); }
};

/// Allocates for `wanted` slices and all cuts by the strata.
Slices make_slices(const Strata& strata, int wanted);

/// Why a surface cannot be analysed.
enum class Cut {
    done,
    above_ground,   ///< the arc leaves the soil between its ends
    leaves_model,   ///< the arc dips below the lowest boundary or reaches past the sides
    closed_region,  ///< the arc crosses a region that cannot fail
    overhangs,      ///< an end is above the centre: the arc would overhang
};

}  // namespace breach::lem
