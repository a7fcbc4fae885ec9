// Inside core/scene only: entries that are plausible individually but not together. The schema
// checks single entries (slips.hpp), core/motion a motion.
#pragma once

#include "core/scene/reader.hpp"

namespace breach::scene {

/// For the valid entries compares the section's size, water with ground, the phases' water tables,
/// time steps with durations and the section's natural period, element and cell sizes with the
/// section, the toe with the mobile soil. Adds faults for impossible combinations and warnings
/// "implausible" for others. Adds a warning to the remedies of faults that it may explain.
void warn_about_together(Reader& reader, Scene& scene);

}  // namespace breach::scene
