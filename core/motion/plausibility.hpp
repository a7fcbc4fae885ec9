// Whether a motion can be what it says: peak, time step and length against what has ever been
// recorded, with the slip of the unit that would explain it. Knows no scene and no file format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"
#include "core/motion/read_motion.hpp"

namespace breach::motion {

/// Peaks of a motion, whichever quantity was recorded.
struct Peaks {
    double acceleration;  ///< PGA [m/s2]; of a velocity by differences
    double velocity;      ///< PGV [m/s]; of an acceleration by the trapezoidal rule
};
Peaks peaks_of(const Recording& motion);

/// "PGA 0.3 g, PGV 0.25 m/s, 28.03 s in steps of 0.01 s".
std::string summary_of(const Recording& motion);

struct Remarks {
    std::vector<fault::Fault> faults;  ///< no ground has moved so
    std::vector<fault::Flag> flags;    ///< "implausible", "drifting_motion"
};

/// Of an acceleration or a velocity as it is applied: scaled, its baseline corrected. All findings
/// point at `pointer`; what is refused is not flagged as well.
Remarks remarks_about(const Recording& motion, const std::string& pointer);

/// One value throughout is no record, whatever its unit; zeros are a motion.
std::optional<fault::Fault> fault_of_constant(const Recording& motion, const std::string& pointer);

/// All of this for those who read a motion without refusing it: what is refused becomes a
/// questionable flag "impossible". Nothing of a displacement.
std::vector<fault::Flag> warnings_about(const Recording& motion, const std::string& pointer);

/// "coarse_step": steps of an analysis that pass over samples of the motion.
std::optional<fault::Flag> warning_about_step(const Series& motion, double time_step,
                                              const std::string& pointer);

}  // namespace breach::motion
