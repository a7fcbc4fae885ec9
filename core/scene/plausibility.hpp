// Inside core/scene only: entries that are each plausible and cannot be meant together. One entry
// by itself is the schema's affair (slips.hpp); a motion's numbers are core/motion's.
#pragma once

#include <vector>

#include "core/scene/reader.hpp"

namespace breach::scene {

/// Compares the entries that were read, as far as the scene is sound: the section's size, water
/// against ground, steps against durations, element and cell sizes against the section, the toe
/// against the soil that runs out. What cannot be is added to the reader's faults; returned is what
/// is hardly meant, as flags "implausible".
std::vector<fault::Flag> doubts_across(Reader& reader, const Scene& scene);

}  // namespace breach::scene
