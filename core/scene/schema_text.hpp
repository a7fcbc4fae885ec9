// The schemas as they were written, with their entries in the order in which people are to be shown
// them. Checking is schema.hpp's.
#pragma once

#include <string>

namespace breach::scene {

const std::string& scene_schema_text();
const std::string& study_schema_text();

}  // namespace breach::scene
