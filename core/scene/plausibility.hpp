// Inside core/scene only: entries that are each plausible and cannot be meant together. One entry
// by itself is the schema's affair (slips.hpp); a motion's numbers are core/motion's.
#pragma once

#include "core/scene/reader.hpp"

namespace breach::scene {

/// Compares the entries that were read, as far as the scene is sound: the section's size, water
/// against ground, the phases' water tables with one another, steps against durations and the
/// section's natural period, element and cell sizes against the section, the toe against the soil
/// that runs out. What cannot be is added to the reader's faults, what is hardly meant to the
/// scene's warnings, as "implausible"; faults that a warn about a neighbouring entry may explain
/// are told of it.
void warn_about_together(Reader& reader, Scene& scene);

}  // namespace breach::scene
