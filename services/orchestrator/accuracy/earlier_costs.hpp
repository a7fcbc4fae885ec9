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
    /// Costs from the newest runs: tasks of each phase that succeeded by computing (not from the
    /// cache), spread over the transfer times, because soil that runs out costs ten times soil that
    /// stays. Cached.
    std::vector<estimate::Earlier> of(const Store& store);

  private:
    std::vector<estimate::Earlier> of_run(const Store& store, const Run& run);

    struct Known {
        std::int64_t tasks_done = 0;
        std::vector<estimate::Earlier> earlier;
    };
    std::mutex mutex_;
    std::map<std::string, Known> runs_;  ///< with the number of tasks done when they were read
};

}  // namespace breach::orchestrator
