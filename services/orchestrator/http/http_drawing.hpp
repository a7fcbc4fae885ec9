// Routes for documents before they are submitted: a picture of the section, and the cost.
#pragma once

#include "services/orchestrator/http/http_router.hpp"
#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

void add_drawing_routes(Router& router, Service& service);

}  // namespace breach::orchestrator
