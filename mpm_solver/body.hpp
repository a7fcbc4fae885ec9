// What a time step works on: the soil's points and zones, the grid, and everything that was
// resolved from the scene before the first step. Also the sums that the step keeps: dissipation,
// fastest point, lost points.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mpm_solver/grid.hpp"
#include "mpm_solver/points.hpp"

namespace breach::mpm {

/// Volume-weighted sums over the points of one zone in a cell; see CellAverages.
struct CellSum {
    double V = 0.0;        ///< [m3]
    double trD = 0.0;      ///< sum of V tr D, then its average [1/s]
    double sigma_m = 0.0;  ///< sum of V sigma_m, then its average [Pa]
};

/// Anti-locking (A3 of mpm.md): the points of a zone in a cell share their volumetric strain rate
/// and mean stress.
struct CellAverages {
    std::vector<CellSum> sums;         ///< per cell
    std::vector<std::int32_t> filled;  ///< cells with V > 0
};

struct Tally {
    double plastic = 0.0;    ///< work dissipated by plastic strain so far [J]
    double friction = 0.0;   ///< work dissipated by the floor's friction so far [J]
    double viscous = 0.0;    ///< work dissipated by viscosity so far [J]
    double pushed_in = 0.0;  ///< work that the overlap correction put in so far [J]
    double kinetic =
        0.0;  ///< of the points at the end of the step; not finite when any velocity is not [J]
    double fastest = 0.0;  ///< largest speed of a point [m/s]
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t lost = none;  ///< a point that left the grid or is nowhere (NaN)
};

struct Body;

/// The parts of a step that depend on options, chosen once. map_again is null unless the order is
/// MUSL.
struct Verbs {
    void (*particle_to_grid)(Body&);
    void (*grid_to_particle)(Body&, double dt);
    void (*map_again)(Body&, double dt);
    void (*update_stress)(Body&, double dt);
};

struct Body {
    Grid grid;
    Points points;
    std::vector<Zone> zones;
    Vec2 gravity;           ///< [m/s2]
    double gimp_half_size;  ///< [cells]
    double blending_rate;   ///< beta [1/s]
    double overlap_rate;    ///< of the overlap correction [1/s]
    Verbs verbs;
    std::vector<CellAverages> averages;  ///< per zone; empty when anti-locking is off
    std::vector<double> drift_x,
        drift_y;  ///< MUSL: velocity that moves the points [m/s]; empty for USL
    Tally tally;
};

/// Everything resolved; `points` are where they are. Throws BadInput (naming `file`) if a point
/// lies outside the grid.
Body make_body(const scene::Scene& scene, ZonedPoints points, const std::string& file);

/// Throws BadInput (naming `file`) if a point lies below the terrain.
void refuse_buried_points(const Body& body, const std::string& file);

/// Kernel of the point's scatter and gather.
template <class Kernel>
Kernel kernel_of(const Body& body);
template <>
inline GimpKernel kernel_of(const Body& body) {
    return GimpKernel(body.gimp_half_size);
}
template <>
inline BSplineKernel kernel_of(const Body&) {
    return {};
}
template <>
inline LinearKernel kernel_of(const Body&) {
    return {};
}

/// Wave speed of the stiffest zone at the density that the force uses [m/s].
double wave_speed(const Body& body);

/// Largest step at this Courant number: cfl h / (c + |v|) [s].
double courant_step(const Body& body, double cfl);

}  // namespace breach::mpm
