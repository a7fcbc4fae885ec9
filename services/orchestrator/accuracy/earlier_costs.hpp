// What finished runs took, over what is estimated for their own scenes: what new estimates learn from.
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
    /// spread over their transfer times: what runs out costs ten times what stays. The answer is quick
    /// the second time.
    std::vector<estimate::Earlier> of(const Store& store);

  private:
    std::vector<estimate::Earlier> of_run(const Store& store, const Run& run);

    struct Known {
        std::int64_t tasks_done = 0;
        std::vector<estimate::Earlier> earlier;
    };
    std::mutex mutex_;
    std::map<std::string, Known> runs_;  ///< what they said when they had as many tasks done
};

}  // namespace breach::orchestrator
