// What POST /v1/import answers: a drawing becomes a scene. Apart from the route, because Eigen and
// httplib cannot be read together.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::orchestrator {

/// {scene, report}. Throws BadInput with every fault of the drawing, or of the request itself.
nlohmann::json imported(const std::string& body);
/// The same as a picture, SVG: of the scene, or of the outlines with their faults in red. Throws
/// BadInput where there is nothing to draw.
std::string picture_of_import(const std::string& body);

}  // namespace breach::orchestrator
