// Results of an uncertainty study as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::cli {

/// answer: of GET /v1/runs/{id}/uncertainty
std::string as_uncertainty_view(const nlohmann::json& answer);

}  // namespace breach::cli
