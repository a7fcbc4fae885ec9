// Whether a motion is plausible: peak, time step and length against the largest ever recorded, with
// the wrong unit that would explain it. Independent of scenes and file formats.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"
#include "core/motion/read_motion.hpp"

namespace breach::motion {

/// Peaks of a motion, recorded as acceleration or velocity.
struct Peaks {
    double acceleration;  ///< PGA [m/s2]; of a velocity by differences
    double velocity;      ///< PGV [m/s]; of an acceleration by the trapezoidal rule
};
Peaks peaks_of(const Recording& motion);

/// "PGA 0.3 g, PGV 0.25 m/s, 28.03 s in steps of 0.01 s".
std::string summary_of(const Recording& motion);

struct Remarks {
    std::vector<fault::Fault> faults;  ///< no ground motion can be so strong
    std::vector<fault::Flag> flags;    ///< "implausible", "drifting_motion"
};

/// For an acceleration or a velocity as it is applied: scaled, its baseline corrected. All findings
/// point at `pointer`; a refused motion is not flagged as well.
Remarks remarks_about(const Recording& motion, const std::string& pointer);

/// A constant series is no record in any unit; zeros are a motion.
std::optional<fault::Fault> fault_of_constant(const Recording& motion, const std::string& pointer);

/// All of this for those who read a motion without refusing it: a fault becomes a questionable flag
/// "impossible". None for a displacement.
std::vector<fault::Flag> warnings_about(const Recording& motion, const std::string& pointer);

/// "coarse_step": steps of an analysis that skip samples of the motion.
std::optional<fault::Flag> warning_about_step(const Series& motion, double time_step,
                                              const std::string& pointer);

}  // namespace breach::motion
