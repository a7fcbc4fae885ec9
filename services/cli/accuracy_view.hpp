// The table of an accuracy study as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::cli {

/// answer: of GET /v1/runs/{id}/accuracy
std::string as_accuracy_table(const nlohmann::json& answer);

}  // namespace breach::cli
