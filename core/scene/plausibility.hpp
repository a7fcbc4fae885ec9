// Inside core/scene only: entries that are plausible one by one but not together. One entry by
// itself is checked by the schema (slips.hpp); a motion's numbers by core/motion.
#pragma once

#include "core/scene/reader.hpp"

namespace breach::scene {

/// Compares the entries that were read, where the scene is valid: the section's size, water
/// against ground, the phases' water tables with one another, steps against durations and the
/// section's natural period, element and cell sizes against the section, the toe against the soil
/// that runs out. Adds impossible combinations to the reader's faults and implausible ones to the
/// scene's warnings, as "implausible"; mentions a warning in faults that a neighbouring entry may
/// explain.
void warn_about_together(Reader& reader, Scene& scene);

}  // namespace breach::scene
