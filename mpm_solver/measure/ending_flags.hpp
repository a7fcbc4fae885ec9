// Flags of a result at its end, with their limits and the reasons for these.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::mpm {

/// Energy that the scheme created or lost, over the energy released. Runs with the usual settings are within a few
/// per cent; the overlap correction with 4 points per cell, which docs/verification/mpm_convergence.md advises
/// against, reaches 22 %. Beyond a fifth the scheme determines the runout.
constexpr double largest_numerical_share = 0.20;

/// Volume of the mobile soil over the initial one. Soil that keeps its volume in plastic flow can
/// open in tension, so more is allowed above 1 than below: a deposit that has lost a fifth of its
/// soil, or is a third air, has neither the right depth nor the right length.
constexpr double least_volume_ratio = 0.8;
constexpr double most_volume_ratio = 1.3;

/// Volume-weighted share of the mobile soil that overlaps other soil: it is missing from the deposit,
/// mostly at the front. Runs with 0.01 to 0.07 went 3 to 17 % less far than those with almost none,
/// one of them 3 % farther (docs/verification/mpm_convergence.md).
constexpr double told_overlap = 0.01;
constexpr double largest_overlap = 0.05;

/// Energy added by the overlap correction, over the energy released. The correction improves results with overlapping
/// soil; but with 9 points per cell it adds 5 to 9 %, also in soil at rest, and a template's dam ran a tenth too far. 16
/// points take 1 to 4 % (docs/verification/mpm_convergence.md).
constexpr double largest_correction_share = 0.05;

/// Cells across the mean depth of the deposit beyond the toe. The Mochikoshi dam with residual strengths from the
/// start ran 68, 140, 180 and 176 m on 1.6, 2.7, 5.2 and 11 (docs/verification/mpm_convergence.md).
constexpr double deposit_cells_wanted = 5.0;

/// Needed for stable soil to stay stable: a bank of 5 m with c 300 kPa fell apart without the first,
/// and a slope with nu 0.45 did not come to rest within 200 s without the second.
constexpr double usual_tension_share = 0.03;
constexpr double usual_damping_ratio = 0.1;

/// For soil that is softer than in the scene: beyond it the flow compresses it by 1 % and more, as
/// in every weakly compressible method.
constexpr double largest_mach = 0.1;

/// End state of a run, for the flags.
struct Ending {
    double time;                        ///< [s]
    std::optional<std::string> moving;  ///< why the soil is not at rest; empty: it is
    double kinetic_share;               ///< of the energy scale, see energy_scale [-]
    double numerical_share;             ///< of the same [-]
    bool stood;  ///< less was released than that scale's minimum, and no front moved by a cell
    double correction_share;  ///< of the same, added by the overlap correction [-]
    double volume_ratio;
    double overlap;
    double deposit_depth;  ///< mean over the soil beyond the toe; 0: none there [m]
    double cell_size;      ///< [m]
    bool until_rest;       ///< the run should go on until rest, and reached its time limit
    double tension_share;  ///< /mpm/tension_share
    double damping_ratio;  ///< /mpm/damping_ratio
    double mach;           ///< largest speed over that of the fastest wave [-]
    bool softer;           ///< soil is softer than in the scene, for longer steps
};

std::vector<fault::Flag> flags_of_ending(const Ending& ending);

}  // namespace breach::mpm
