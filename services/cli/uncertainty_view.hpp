// What an uncertainty study found, for people's eyes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::cli {

/// answer: of GET /v1/runs/{id}/uncertainty
std::string as_uncertainty_view(const nlohmann::json& answer);

}  // namespace breach::cli
