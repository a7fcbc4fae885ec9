// Cost of finished runs relative to the estimates for their own scenes: the basis of new estimates.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "services/estimate/cost.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

class EarlierCosts {
  public:
    /// Of the newest runs, some tasks of each phase that succeeded by computing (not from the cache),
    /// spread over their transfer times: soil that runs out costs ten times soil that stays. Cached: a
    /// second call is fast.
    std::vector<estimate::Earlier> of(const Store& store);

  private:
    std::vector<estimate::Earlier> of_run(const Store& store, const Run& run);

    struct Known {
        std::int64_t tasks_done = 0;
        std::vector<estimate::Earlier> earlier;
    };
    std::mutex mutex_;
    std::map<std::string, Known> runs_;  ///< ratios, and the number of tasks done then
};

}  // namespace breach::orchestrator
