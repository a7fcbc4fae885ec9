// The description of this API (OpenAPI 3.1) and its examples: openapi.json and examples.json, built
// into the program. http_pages.cpp completes them.
#pragma once

#include <string>

namespace breach::orchestrator {

const std::string& openapi_text();
const std::string& examples_text();

}  // namespace breach::orchestrator
