// What an uncertainty study found, in sentences for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::orchestrator {

/// findings: the answer of GET /v1/runs/{id}/uncertainty so far.
std::vector<std::string> sentences_of(const nlohmann::json& findings);

}  // namespace breach::orchestrator
