// A sliding mass above a circular arc, cut into vertical slices at every material boundary and
// ground vertex. Geometry, weight and strength of each slice; no factor of safety here.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/scene.hpp"
#include "lem_tool/strata.hpp"

namespace breach::lem {

/// A circle's lower arc between the two points where it meets the ground.
struct Surface {
    scene::Circle circle;
    double left;   ///< x [m]
    double right;  ///< x [m]

    double level(double x) const;  ///< y of the arc [m]
};

/// Where a circle's lower arc meets a straight line within (from, to), ascending.
struct Meeting {
    int count = 0;
    double x[2];
};
Meeting meet(const scene::Circle& circle, const Line& line, double from, double to);

/// Strength of a region as limit equilibrium sees it.
struct Soil {
    double c;        ///< [Pa]
    double tan_phi;  ///< [-]
    double r_u;  ///< pore pressure over the soil's vertical stress, where no water line counts [-]
    enum class Passage {
        open,
        closed
    } passage;  ///< closed: stronger than any surface (linear elastic)
};

/// Slices from left to right, one array per quantity; `resize`d once, then only `count` changes.
struct Slices {
    std::size_t count = 0;
    double depth = 0.0;          ///< greatest vertical depth of the mass [m]
    std::vector<double> left;    ///< x of the left side [m]
    std::vector<double> width;   ///< [m]
    std::vector<double> base;    ///< y of the base's middle [m]
    std::vector<double> sin_a;   ///< base inclination, positive when rising to the right [-]
    std::vector<double> cos_a;   ///< [-]
    std::vector<double> length;  ///< arc length of the base [m]
    std::vector<double> weight;  ///< soil, surcharge and free water above [N/m]
    std::vector<double> u;       ///< pore pressure at the base [Pa]
    std::vector<double>
        driving;  ///< moment of all vertical loads and of free water about the centre over R [N/m]
    std::vector<double> shaking;  ///< moment of the soil's weight, put horizontal, over R [N/m]
    std::vector<double> force;    ///< c l cos a + (W - u l cos a) tan phi: Bishop's numerator [N/m]
    std::vector<double> c;        ///< [Pa]
    std::vector<double> tan_phi;  ///< [-]
    std::vector<double> crossings;  ///< scratch of the cutting

    void reserve(std::size_t slices, std::size_t most_layers);
    std::size_t capacity() const { return left.size(); }
};

/// Room for `wanted` slices and every cut that the strata can make.
Slices make_slices(const Strata& strata, int wanted);

/// Why a surface cannot be analysed.
enum class Cut {
    done,
    above_ground,   ///< the arc leaves the soil between its ends
    leaves_model,   ///< the arc dips below the lowest boundary or reaches past the sides
    closed_region,  ///< the arc passes through a region that cannot fail
    overhangs,      ///< an end lies above the centre: the arc would lean back over the mass
};

/// Cuts the mass into about `wanted` slices of equal width, more where boundaries ask for it. Arc
/// segments are exact in weight, moment and (to the fourth order of their angle) length; only the
/// base inclination is that of the chord. No allocation.
Cut cut(const Strata& strata, const std::vector<Soil>& soils, const Surface& surface, int wanted,
        Slices& slices);

}  // namespace breach::lem
