// Documents before they are submitted: their section as a picture, and what they will cost. Apart from
// the routes, because Eigen and httplib cannot be read together.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

enum class MeshDrawn { no, yes };

/// What POST /v1/draw answers: SVG, of faulty documents as well. A mesh is made by fem_solver and kept
/// in the data folder. Throws BadInput where there is nothing to draw, or a mesh that is asked for
/// cannot be made.
std::string picture_of(const Service& service, const std::string& body, MeshDrawn mesh);

/// What POST /v1/cost answers. Throws BadInput with all that the submission of a study would be refused for.
nlohmann::json cost_of(const Service& service, const std::string& body);

}  // namespace breach::orchestrator
