// Adds variants to uncertainty studies, on the dispatcher's thread. An inverse study gets the next
// value of the parameter until the target is met (ensemble/inverse_search.hpp). A study with
// "until" gets batches of samples until the percentile is accurate enough or all requested samples
// exist.
//
// The store keeps this as a trigger on the run's first task, with a "percentile" or a "target" in
// its spec. While it is armed the run is not over; cancelling disarms it. Decisions depend on the
// stored results only, so that a restart repeats them.
#pragma once

#include <map>
#include <string>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// The trigger of a study with "until" or "target"; nothing for others.
std::optional<TriggerPlan> batches_of(const Study& study);

class BatchWatch {
  public:
    BatchWatch(Store& store, const DataFolder& data, const Numerics& numerics)
        : store_(store), data_(data), numerics_(numerics) {}

    /// Checks the runs whose samples have all ended; true: tasks were added. Cheap when nothing was
    /// stored since the last call. A run that cannot continue (a full disk) delays no other and is
    /// tried again.
    bool look();

  private:
    bool settle(const Trigger& trigger);
    bool has_ended(const std::string& run) const;
    bool draw_on(const Trigger& trigger, const nlohmann::json& study);
    bool search_on(const Trigger& trigger);
    bool extend(const Trigger& trigger, const nlohmann::json& study, const nlohmann::json& entry);
    void end(const Trigger& trigger, TriggerEvent event, const nlohmann::json& result,
             const std::string& why);

    Store& store_;
    const DataFolder& data_;
    const Numerics& numerics_;
    std::int64_t seen_event_ = -1;                 ///< all events up to this one are settled
    std::map<std::string, std::string> troubles_;  ///< of the last call, by run
};

}  // namespace breach::orchestrator
