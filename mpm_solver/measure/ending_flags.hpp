// Flags of a finished run, with their limits.
// write_results raises them once per run; docs/reference/flags.md lists them for readers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::mpm {

/// Energy created or lost by the scheme, over the energy released. Usual settings give a few per
/// cent; the overlap correction with 4 points per cell, which docs/verification/mpm_convergence.md
/// advises against, up to 22 %. Beyond a fifth the scheme determines the runout.
constexpr double largest_numerical_share = 0.20;

/// Volume of the mobile soil over the initial one. Soil with isochoric plastic flow can open in
/// tension, so the limit above 1 is wider. A deposit that has lost a fifth of its soil, or is a
/// third air, has the wrong depth and length.
constexpr double least_volume_ratio = 0.8;
constexpr double most_volume_ratio = 1.3;

/// Volume-weighted share of the mobile soil that overlaps other soil and is missing in the deposit,
/// mostly at the front. Runs with 0.01 to 0.07 went 3 to 17 % less far than those with almost none,
/// one of them 3 % farther (docs/verification/mpm_convergence.md).
constexpr double told_overlap = 0.01;
constexpr double largest_overlap = 0.05;

/// Energy added by the overlap correction, over the energy released. The correction improves runs
/// with overlap. But with 9 points per cell it adds 5 to 9 %, also in soil at rest, and a
/// template's dam ran 10 % too far; with 16 points 1 to 4 % (docs/verification/mpm_convergence.md).
constexpr double largest_correction_share = 0.05;

/// Cells across the mean depth of the deposit beyond the toe. The Mochikoshi dam with residual
/// strengths from the start ran 68, 140, 180 and 176 m with 1.6, 2.7, 5.2 and 11
/// (docs/verification/mpm_convergence.md).
constexpr double deposit_cells_wanted = 5.0;

/// Needed to keep stable soil stable: a bank of 5 m with c = 300 kPa fell apart without the first,
/// and a slope with nu = 0.45 did not come to rest within 200 s without the second.
constexpr double usual_tension_share = 0.03;
constexpr double usual_damping_ratio = 0.1;

/// Limit of the Mach number for soil softer than in the scene: beyond it the flow compresses the
/// soil by 1 % and more, as in any weakly compressible method.
constexpr double largest_mach = 0.1;

/// End state of a run, for the flags.
struct Ending {
    double time;                        ///< [s]
    std::optional<std::string> moving;  ///< why the soil moves; empty: at rest
    double kinetic_share;               ///< of the energy scale (energy_scale) [-]
    double numerical_share;             ///< of the same [-]
    /// less energy was released than the scale's minimum, and no front moved by a cell
    bool stood;
    double correction_share;  ///< of the same, by the overlap correction [-]
    double volume_ratio;
    double overlap;
    double deposit_depth;    ///< mean over the soil beyond the toe; 0: none there [m]
    double cell_size;        ///< [m]
    bool until_rest;         ///< the run should continue to rest, and reached its time limit
    double tension_share;    ///< /mpm/tension_share
    double damping_ratio;    ///< /mpm/damping_ratio
    double overlap_rate;     ///< /mpm/overlap_correction/rate
    double points_per_cell;  ///< mean at the start
    bool filled;             ///< the points fill the section; false: from a transfer
    bool scaled;             ///< /mpm/stiffness_scale is a number
    double mach;             ///< largest speed over the fastest wave [-]
    bool softer;             ///< soil is softer than in the scene, for longer time steps
};

std::vector<fault::Flag> flags_of_ending(const Ending& ending);

}  // namespace breach::mpm
