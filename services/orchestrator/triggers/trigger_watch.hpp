// Watches the FEMs with open triggers, on the dispatcher's thread: reads each file as it grows
// (watched_fem.hpp), and settles its triggers (settling.hpp).
#pragma once

#include <chrono>
#include <map>

#include "services/orchestrator/triggers/settling.hpp"

namespace breach::orchestrator {

class TriggerWatch {
  public:
    TriggerWatch(Store& store, const DataFolder& data)
        : store_(store), data_(data), settling_(store) {}

    /// Readable when a watched telemetry file has grown.
    int descriptor() const { return watch_.descriptor(); }
    /// Longest time until the next look: zero after something was stored, short while a FEM has not
    /// begun its telemetry.
    std::chrono::milliseconds patience() const;
    /// Reads everything that may have changed; cheap when no trigger is open.
    void look();

  private:
    void load_open_triggers();
    void forget_what_is_not(const std::vector<Trigger>& open);
    void arm(const Trigger& trigger);
    void look_alone(WatchedFem& fem);

    Store& store_;
    const DataFolder& data_;
    FolderWatch watch_;
    Settling settling_;
    std::map<std::string, WatchedFem> fems_;  ///< by task id
    std::int64_t seen_event_ = -1;
    std::chrono::steady_clock::time_point loaded_{};
};

}  // namespace breach::orchestrator
