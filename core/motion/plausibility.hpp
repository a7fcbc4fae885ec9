// Plausibility of a motion: compares peak, time step and length with the largest ever recorded and
// names the wrong unit that would explain an excess. Independent of scenes and file formats.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"
#include "core/motion/read_motion.hpp"

namespace breach::motion {

struct Peaks {
    double acceleration;  ///< PGA [m/s2]; from a velocity by differences
    double velocity;      ///< PGV [m/s]; from an acceleration by the trapezoidal rule
};
Peaks peaks_of(const Recording& motion);

/// "PGA 0.3 g, PGV 0.25 m/s, 28.03 s in steps of 0.01 s".
std::string summary_of(const Recording& motion);

struct Remarks {
    std::vector<fault::Fault> faults;  ///< stronger than any possible ground motion
    std::vector<fault::Flag> flags;    ///< "implausible", "drifting_motion"
};

/// For an acceleration or a velocity as it is applied (scaled, baseline-corrected). All remarks
/// have this `pointer`; a refused motion is not flagged in addition.
Remarks remarks_about(const Recording& motion, const std::string& pointer);

/// Refuses a constant series in any unit; all zeros are allowed.
std::optional<fault::Fault> fault_of_constant(const Recording& motion, const std::string& pointer);

/// The same for readers that never refuse: a fault becomes a questionable flag "impossible". None
/// for a displacement.
std::vector<fault::Flag> warnings_about(const Recording& motion, const std::string& pointer);

/// "coarse_step": time steps that skip samples of the motion.
std::optional<fault::Flag> warning_about_step(const Series& motion, double time_step,
                                              const std::string& pointer);

}  // namespace breach::motion
