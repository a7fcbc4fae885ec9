// Statistics of an uncertainty study's results (percentiles, exceedance, importance, tornado), also
// in sentences.
#pragma once

#include <nlohmann/json.hpp>

#include "services/orchestrator/uncertainty/ensemble.hpp"

namespace breach::orchestrator {

/// The answer of GET /v1/runs/{id}/uncertainty. scene: of the run. quantity: only this one; empty:
/// all. An inverse study has no statistics: its values are not sampled.
nlohmann::json uncertainty_of(const Ensemble& ensemble, const nlohmann::json& scene,
                              const std::string& quantity = {});

}  // namespace breach::orchestrator
