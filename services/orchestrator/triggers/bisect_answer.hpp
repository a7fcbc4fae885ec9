// What a bisect goes by and comes to: the snapshots that it may transfer at, what the runouts there
// say, its result.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/statistics/bisection.hpp"
#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/records/trigger.hpp"

namespace breach::orchestrator {

/// In its range, at least its tolerance apart.
std::vector<Frame> candidates_of(const Bisect& bisect, const std::vector<Frame>& snapshots);

/// By the samples, which have all ended.
statistics::Advice advice_for(const Bisect& bisect, const std::vector<Frame>& candidates,
                              const std::vector<Sample>& samples);

/// "result" of the trigger.
nlohmann::json result_of(const Bisect& bisect, const std::vector<Frame>& candidates,
                         const std::vector<Sample>& samples, const statistics::Advice& advice);

}  // namespace breach::orchestrator
