// The entry "budget" of a study, on its own: as a cost is held against it, or a run gets another.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace breach::orchestrator {

/// CPU seconds. Throws BadInput below /budget.
double checked_budget(const nlohmann::json& entry);

}  // namespace breach::orchestrator
