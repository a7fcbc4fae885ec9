// The inner loops over points, and their data as plain arrays and numbers. Compiled once per
// instruction set: this file must not contain types or inline functions whose layout or code
// depends on compiler flags (no Eigen, no containers). A zone's loops are selected before the first
// step.
// Called through for_all_points (share.hpp) only, which makes a ZoneWork per strip and zone and
// adds the Totals in a fixed order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/grid/kernel.hpp"
#include "core/materials/lane_law.hpp"
#include "mpm_solver/loops/point_reals.hpp"

namespace breach::mpm {

using grid::GimpKernel;
using grid::Stencil;
using grid::WallRows;

/// Points [begin, end).
struct Span {
    std::size_t begin;
    std::size_t end;
};

/// The arrays of Points; null if not used.
struct PointArrays : PointReals<double*> {
    std::int32_t* cell;
};

struct GridArrays {
    double* mass;
    double* motion;       ///< four per node
    const double* still;  ///< pressure of standing water at the nodes; null without [Pa]
    std::int32_t rows;
    double h, per_h;
    double x_0, y_0;  ///< of the first ghost node [m]
    double low_x, high_x, low_y, high_y;
    WallRows walls_x;
    WallRows walls_y;
};

/// Volume-weighted sums over the points of one zone in a cell; see Body::averages.
struct CellSum {
    double V = 0.0;        ///< [m3]
    double trD = 0.0;      ///< sum of V tr D, then average [1/s]
    double sigma_m = 0.0;  ///< sum of V sigma_m, then average [Pa]
};

/// Data of one zone's loops in one step.
struct ZoneWork {
    PointArrays points;
    GridArrays grid;
    CellSum* cells;   ///< null without averages
    const void* law;  ///< of the type in materials::LaneLaws for which the loops were selected
    materials::Moduli moduli;
    double eta;             ///< viscosity [Pa s]
    double damping;         ///< additional viscosity of soil that does not yield [Pa s]
    double damping_return;  ///< share restored per step after yielding [-]
    double gimp_half_size;
    double dt;
    double blend;         ///< beta dt, at most 1 [-]
    double overlap_rate;  ///< [1/s]
    double widest;        ///< volume beyond which a point does not expand [m3]
};

/// Sums of a loop over its points.
struct Totals {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    double kinetic = 0.0;  ///< [J]
    double fastest_squared = 0.0;
    double farthest = 0.0;    ///< largest move of a point along an axis [m]
    std::size_t lost = none;  ///< first point that left the grid
    double plastic = 0.0;
    double viscous = 0.0;
    double pushed_in = 0.0;
    double largest_specific_volume = 0.0;
};

using Loop = void (*)(const ZoneWork&, Span, Totals&);

/// One zone's loops in the order of the step; null if not used.
struct Loops {
    // Writes nodes that neighbouring strips share; so do gather and stress with the cells of
    // anti-locking. settle and dissipate write their own points only.
    Loop scatter = nullptr;  ///< mass, momentum and force
    Loop gather = nullptr;
    Loop stress = nullptr;
    Loop settle = nullptr;     ///< cell averages of mean stress, and volumes
    Loop dissipate = nullptr;  ///< work of viscosity
};

enum class Averages { none, per_cell };
enum class Overlap { left_alone, corrected };
enum class Viscosity { none, newtonian };
enum class Medium { air, water };
/// The volume in the internal force.
enum class VolumeRule {
    tracked,  ///< V = volume: laws without cracks, or gap closure off
    /// V = V_0 (1 + sigma_m / K): opened gaps carry no stress (docs/reference/methods/mpm.md, *One
    /// step*)
    from_stress,
};

/// Selects a zone's loops.
struct Choice {
    std::size_t law;  ///< its index in materials::LaneLaws
    Averages averages;
    Overlap overlap;
    Viscosity viscosity;
    Medium medium;
    VolumeRule volume_rule;
};

Loops plain_loops(const Choice& choice);
Loops avx2_loops(const Choice& choice);
Loops avx512_loops(const Choice& choice);

}  // namespace breach::mpm
