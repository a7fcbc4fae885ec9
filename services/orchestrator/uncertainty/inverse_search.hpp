// State of an inverse study: the values computed so far, and the advice for the next value.
// BatchWatch acts on the advice when all samples have ended; uncertainty_of shows it at any time.
#pragma once

#include "services/orchestrator/study/target.hpp"
#include "services/orchestrator/uncertainty/ensemble.hpp"

namespace breach::orchestrator {

struct InverseSearch {
    Target target;
    std::vector<statistics::InverseStep> steps;  ///< ascending in the value
    statistics::InverseAdvice advice;
};

/// Nothing: the study has no target. scene: of the run.
std::optional<InverseSearch> inverse_search(const Ensemble& ensemble, const nlohmann::json& scene);

/// "inverse" of GET /v1/runs/{id}/uncertainty
nlohmann::json as_json(const InverseSearch& search, const std::string& vary);

}  // namespace breach::orchestrator
