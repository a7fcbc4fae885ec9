// The cross-section as vertical strips, within which every boundary is one straight line: the
// weight above a point is a linear function.
// Made once per scene (make_model) and again for other floors or bounds; arcs and polylines only
// look things up in it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

/// y = level + slope x.
struct Line {
    double level;
    double slope;
    double at(double x) const { return level + slope * x; }
};

/// The soil between its upper boundary and that of the next layer (or the strip's bottom).
struct Layer {
    Line top;            ///< [m]
    std::size_t region;  ///< index into the section's regions
    double gamma;        ///< unit weight [N/m3]
    Line weight_above;   ///< weight per area of everything above `top` [Pa]
    /// effective load of the soil above that has not consolidated the soil below [Pa]
    Line unconsolidated;
};

struct Strip {
    double from;        ///< [m]
    double to;          ///< [m]
    std::size_t first;  ///< layers first .. last - 1, from the ground down
    std::size_t last;
    Line bottom;       ///< lower border of the model, or the search's lowest level if higher [m]
    Line floor;        ///< lower limit of surfaces; -inf: none [m]
    Line water;        ///< line of /lem/water, below ground or free water above it; -inf: none [m]
    double surcharge;  ///< vertical pressure on the ground [Pa]
    std::size_t pressures;  ///< index of its first one in Strata::pressures
};

/// Pore pressure of one phreatic line within a strip: at_top + gamma (top - y) below `top`, 0 above
/// it. Under free water `top` is the ground.
struct PorePressure {
    Line top;      ///< [m]
    Line at_top;   ///< [Pa]
    double gamma;  ///< increase with depth [N/m3]

    double at(double x, double y) const {
        const double below = top.at(x) - y;
        return below > 0.0 ? at_top.at(x) + gamma * below : 0.0;
    }
};

/// Push of free water on a vertical face.
struct WaterPush {
    double x;      ///< [m]
    double level;  ///< [m]
    double left;   ///< towards the left [N/m]
};

/// Vertical crack at the upper end of every surface.
struct Crack {
    enum class Reach { none, depth, level };
    Reach reach = Reach::none;
    double foot = 0.0;     ///< depth below ground, or level [m]
    double share = 1.0;    ///< used share of that height (lem_tool/crack.hpp) [-]
    double filled = 0.0;   ///< share of its height filled with water [-]
    double gamma_w = 0.0;  ///< [N/m3]
};

struct Strata {
    std::vector<Strip> strips;  ///< left to right, without gaps
    std::vector<Layer> layers;
    /// lines of each strip, in order: /lem/water, piezometric_lines
    std::vector<PorePressure> pressures;
    std::size_t lines = 0;
    std::vector<WaterPush> pushes;
    Crack crack;
    double gamma_w = 0.0;  ///< unit weight of free water [N/m3]; 0 without /lem/water

    double left() const { return strips.front().from; }
    double right() const { return strips.back().to; }
    const Line& ground(const Strip& strip) const { return layers[strip.first].top; }
    /// Tip of the crack; the ground where the crack does not reach below it.
    Line crack_foot(const Strip& strip) const;
};

/// Hydrostatic thrust on a vertical face between `low` and `high`.
struct Thrust {
    double force;  ///< [N/m]
    double level;  ///< of its line of action [m]
};
Thrust thrust(double gamma_w, double water, double low, double high);

/// Divides the section at every vertex, point of water or floor, end of a surcharge, and where
/// water or floor cross a boundary. Throws BadInput for air below ground (overhang, cavity, two
/// separate bodies): vertical slices do not allow it.
Strata make_strata(const scene::Scene& scene);

/// Water line of each region: its own, or /lem/water unless that names other regions. Index from
/// Strip::pressures on.
std::vector<std::optional<std::size_t>> lines_of_regions(const scene::Scene& scene);

/// Index of the strip at x, the left one on a border; x is clamped to the model.
std::size_t strip_at(const Strata& strata, double x);

/// Ground level [m] at the left or right of x; they differ at a vertical face.
enum class From { left, right };
double ground_level(const Strata& strata, double x, From from);

}  // namespace breach::lem
