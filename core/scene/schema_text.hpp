// The schemas' text, with entries in display order.
#pragma once

#include <string>

namespace breach::scene {

const std::string& scene_schema_text();
const std::string& study_schema_text();

}  // namespace breach::scene
