// The schemas as written, with their entries in the order for display. schema.hpp does the
// checking.
#pragma once

#include <string>

namespace breach::scene {

const std::string& scene_schema_text();
const std::string& study_schema_text();

}  // namespace breach::scene
