// Settles triggers from the data of their FEM: each fires, expires or waits on. Stores the result.
//
// The decision is a function of the telemetry and of the existing snapshots, both on the disk:
// after a kill -9 the replay gives the same firing, and the store accepts it once.
//
// The snapshot of a firing is the first one not before the time at which the trigger was met. While
// there is none and the FEM runs, the service requests one (the file snapshot_request in the FEM's
// output folder), unless the FEM writes snapshots regularly. After the FEM's end an existing
// snapshot must serve; if it is later than within_s, the trigger expires.
//
// The end of an interrupted FEM (failed, but not by a breakdown) closes no window and begins no
// bisection: the triggers expire. So does a trigger that waits for a stability analysis or a runout
// that was interrupted. A retry re-arms them.
#pragma once

#include "services/orchestrator/triggers/watched_fem.hpp"

namespace breach::orchestrator {

class Settling {
  public:
    explicit Settling(Store& store) : store_(store) {}
    void settle(WatchedFem& fem, ArmedTrigger& armed);

  private:
    void settle_work(WatchedFem& fem, ArmedTrigger& armed, Manual& manual);
    void settle_work(WatchedFem& fem, ArmedTrigger& armed, When& when);
    void settle_work(WatchedFem& fem, ArmedTrigger& armed, Between& between);
    void settle_work(WatchedFem& fem, ArmedTrigger& armed, Bisect& bisect);
    void pick_in_window(const WatchedFem& fem, ArmedTrigger& armed, const Between& between);
    void take_first_from(WatchedFem& fem, ArmedTrigger& armed, double wanted);
    void take(const WatchedFem& fem, ArmedTrigger& armed, const Frame& snapshot, double wanted);
    /// Whether the condition was met, and only a snapshot, a window or the rest of its hold was
    /// missing; not_told: the trigger expired for another reason, which leaves this open.
    enum class WasMet { no, yes, not_told };
    void expire(ArmedTrigger& armed, const std::string& why, WasMet was_met);
    void expire_unmet(const WatchedFem& fem, ArmedTrigger& armed,
                      const criteria::Criterion& criterion);
    void expire_without_snapshot(ArmedTrigger& armed, double wanted);
    /// result: stored with the move; null: keeps the stored one.
    void move(ArmedTrigger& armed, TriggerEvent event, nlohmann::json detail,
              const nlohmann::json& result = nullptr);

    Store& store_;
};

}  // namespace breach::orchestrator
