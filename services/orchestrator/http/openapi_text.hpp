// The description of this API (OpenAPI 3.1), openapi.json beside this file: built into the program.
#pragma once

#include <string>

namespace breach::orchestrator {

const std::string& openapi_text();

}  // namespace breach::orchestrator
