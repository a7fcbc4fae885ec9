// The entry "budget" of a study by itself, to compare it with a cost or to change a run's budget.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace breach::orchestrator {

/// CPU seconds. Throws BadInput below /budget.
double checked_budget(const nlohmann::json& entry);

}  // namespace breach::orchestrator
