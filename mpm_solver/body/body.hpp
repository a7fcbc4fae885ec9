// The data of a time step: points and zones, grid, constants from the scene, and sums over the
// steps (dissipation, fastest point, lost points).
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "core/numerics/team.hpp"
#include "core/scene/standing_water.hpp"
#include "mpm_solver/body/choose.hpp"
#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/nonlocal.hpp"
#include "mpm_solver/body/points.hpp"
#include "mpm_solver/body/strips.hpp"

namespace breach::mpm {

/// Filled by the operations of step.cpp. The works accumulate over the whole run, checkpoints
/// included; kinetic and fastest are those of the last step; strayed returns to 0 with each sort;
/// once lost is set, Simulation ends the run (guard.hpp).
struct Tally {
    double plastic = 0.0;    ///< work dissipated by plastic strain so far [J]
    double friction = 0.0;   ///< work dissipated by the floor's friction so far [J]
    double viscous = 0.0;    ///< work dissipated by viscosity so far [J]
    double pushed_in = 0.0;  ///< work of the overlap correction so far [J]
    double shaking = 0.0;    ///< work of the moving frame's inertial force so far [J]
    /// Of the points at the end of the step; not finite if a velocity is not [J].
    double kinetic = 0.0;
    double fastest = 0.0;  ///< largest speed of a point [m/s]
    double strayed = 0.0;  ///< largest distance of a point from its home node, per axis [cells]
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t lost = none;  ///< a point that left the grid or is NaN
};

/// How to compute; the results do not depend on the number of threads.
struct Computing {
    int threads = 1;
    InstructionSet instructions = best_instruction_set();
};

/// Made by make_body at the start or from a checkpoint, owned by Simulation. After that only
/// step.hpp, OverlapMeter (excess and gaps) and Simulation (frame_acceleration) change it.
struct Body {
    Grid grid;
    Points points;
    std::vector<Zone> zones;
    Vec2 gravity;  ///< [m/s2]
    /// Horizontal acceleration of the grid over the next step; set by the simulation [m/s2].
    double frame_acceleration = 0.0;
    /// The same for every number of points per cell: domains as large as a point's share of the
    /// cell made runouts depend on that number.
    double gimp_half_size;  ///< [cells]
    double blending_rate;   ///< beta [1/s]
    double overlap_rate;    ///< of the overlap correction [1/s]
    /// Volume of the four cells around a point [m3]. A point with a larger volume has no
    /// neighbours, and its velocity gradient would expand it without limit.
    double widest;
    /// Anti-locking (docs/reference/methods/mpm.md): the points of a zone in a cell share
    /// volumetric strain rate and mean stress. [zones][cells]; empty: off.
    std::vector<std::vector<CellSum>> averages;
    std::vector<Loops> loops;  ///< per zone
    NonlocalSoftening softening;
    scene::StandingWater water;  ///< none without /mpm/water
    Strips strips;
    std::shared_ptr<numerics::Team> team;
    std::vector<Totals> sums;  ///< [zones * strips]
    Tally tally;
};

/// Precomputes everything; the points keep their positions. `steady`: pore pressure of the FEM for
/// /mpm/water. Throws BadInput with `file` if a point is outside the grid.
/// Points with homes (a checkpoint's) keep their order, in which sums are added; others are sorted.
Body make_body(const scene::Scene& scene, ZonedPoints points, const std::string& file,
               const Computing& computing = {}, const mechanics::NodalField& steady = {});

/// Throws BadInput with `file` if a point is below the terrain.
void refuse_buried_points(const Body& body, const std::string& file);

/// Wave speed of the stiffest zone, with the density in the force [m/s].
double wave_speed(const Body& body);

/// Additional wave speed for viscosity in the Courant step, 16 eta / (3 rho h) [m/s]: lagged
/// damping with the eigenvalue (4/3) eta 8 / (rho h^2) is stable up to half its period.
double viscous_speed(const Zone& zone, double eta, double h);

/// Largest Courant number of stable explicit steps; damping uses the margin below it.
/// The prototype kept its points up to 0.73 to 0.9 and lost them beyond.
inline constexpr double largest_courant = 0.8;

/// Largest step at this Courant number: cfl h / (c + |v|) [s].
double courant_step(const Body& body, double cfl);

}  // namespace breach::mpm
