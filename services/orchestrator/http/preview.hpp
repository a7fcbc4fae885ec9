// Picture and cost of documents before they are submitted. Both know the request's body, but
// nothing of HTTP; they run on the request's thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

enum class MeshDrawn { no, yes };

/// The answer of POST /v1/draw: SVG, of faulty documents as well. fem_solver makes the mesh, which
/// is kept in the data folder's scratch until the service starts again. Throws BadInput where there
/// is nothing to draw, or the mesh cannot be made.
std::string picture_of(const Service& service, const std::string& body, MeshDrawn mesh);

/// The answer of POST /v1/cost. Throws BadInput with all faults that would refuse the study.
nlohmann::json cost_of(const Service& service, const std::string& body);

}  // namespace breach::orchestrator
