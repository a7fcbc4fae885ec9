// Adds variants to uncertainty studies, on the dispatcher's thread. An inverse study gets the next
// value of the parameter until the target is met (uncertainty/inverse_search.hpp). A study with
// "until" gets batches of samples until the percentile is accurate enough or all requested samples
// exist.
//
// The store keeps a row of it per run (Batches in records/records.hpp). Decisions depend on the
// stored results only, so that a restart repeats them.
#pragma once

#include <map>
#include <string>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

class BatchWatch {
  public:
    BatchWatch(Store& store, const DataFolder& data, const Numerics& numerics)
        : store_(store), data_(data), numerics_(numerics) {}

    /// Checks the runs whose samples have all ended; true: tasks were added. Cheap when nothing was
    /// stored since the last call. A run that cannot continue (a full disk) delays no other and is
    /// tried again.
    bool look();

  private:
    bool settle(const Batches& batches);
    bool has_ended(const std::string& run) const;
    bool draw_on(const Batches& batches, const nlohmann::json& study);
    bool search_on(const Batches& batches);
    bool extend(const Batches& batches, const nlohmann::json& study, const nlohmann::json& entry);
    void end(const Batches& batches, const char* state, const std::string& why);

    Store& store_;
    const DataFolder& data_;
    const Numerics& numerics_;
    std::int64_t seen_event_ = -1;                 ///< all events up to this one are settled
    std::map<std::string, std::string> troubles_;  ///< of the last call, by run
};

}  // namespace breach::orchestrator
