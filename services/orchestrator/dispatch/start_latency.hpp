// How long tasks wait before they are given to the executor, for the metrics.
#pragma once

#include "services/orchestrator/dispatch/clock_of_day.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

class StartLatency {
  public:
    /// The task was given to the executor now.
    void note(const Store& store, const DataFolder& data, const Task& task);

    /// Seconds from ready to given to the executor; from the snapshot's appearance on its disk to
    /// the start of what waited for it.
    const Histogram& queue_wait() const { return queue_wait_; }
    const Histogram& snapshot_to_start() const { return snapshot_to_start_; }

  private:
    ClockOfDay clock_;
    Histogram queue_wait_{{0.01, 0.03, 0.1, 0.3, 1, 3, 10, 60, 600, 3600}};
    Histogram snapshot_to_start_{{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 5, 30}};
};

}  // namespace breach::orchestrator
