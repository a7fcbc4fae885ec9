// Documents before they are submitted: their section as a picture, and what they will cost.
#pragma once

#include "services/orchestrator/http/http_router.hpp"
#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

void add_drawing_routes(Router& router, Service& service);

}  // namespace breach::orchestrator
