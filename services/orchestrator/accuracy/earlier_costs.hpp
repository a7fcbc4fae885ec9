// What finished runs took, over what is estimated for their own scenes: what new estimates learn from.
#pragma once

#include <vector>

#include "services/estimate/cost.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// Of the newest runs, some tasks of each phase that succeeded by computing (not from the cache),
/// spread over their transfer times: what runs out costs ten times what stays. The answer is quick
/// the second time.
std::vector<estimate::Earlier> earlier_costs(const Store& store);

}  // namespace breach::orchestrator
