// Watches the FEMs that have open triggers: reads their telemetry as it grows, decides, asks for
// snapshots, and stores firings with the tasks that they make. Runs on the dispatcher's thread.
//
// What is decided is a function of the telemetry and of the snapshots that exist, both on the disk:
// after a kill -9 the replay comes to the same firing, and the store takes it once.
//
// The snapshot of a firing is the first one not before the time at which the trigger was met. While
// there is none and the FEM runs, it is asked for one (the file snapshot_request in its output
// folder), unless it takes regular ones anyway. When the FEM has ended, what exists must serve; a
// snapshot later than the trigger's within_s makes it expire. The end of a FEM that was cut short
// (it failed, and not by a breakdown) closes no window and begins no bisection: they expire. So
// does what waits for a stability analysis or a runout that failed like this: nothing is decided by
// a fault of the machine, and a retry decides.
#pragma once

#include <chrono>
#include <map>

#include "core/telemetry/lines.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/files/folder_watch.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

class TriggerWatch {
  public:
    TriggerWatch(Store& store, const DataFolder& data) : store_(store), data_(data) {}

    /// Readable when a watched telemetry file has grown.
    int descriptor() const { return watch_.descriptor(); }
    /// How long it can do without another look: no time when something was stored since the last, a
    /// moment while a FEM has not begun its telemetry.
    std::chrono::milliseconds patience() const;
    /// Looks at everything that may have moved on; cheap when nothing is open.
    void look();

  private:
    struct Snapshot {
        double time;
        std::string name;
    };
    /// A trigger at work.
    struct Armed {
        Trigger trigger;
        Work work;
        std::int64_t noticed_at = 0;  ///< when the line that met it was read [ms since 1970]
        nlohmann::json crossed = nullptr;
        std::int64_t crossed_step = 0;
        std::size_t lines_taken = 0;  ///< of the FEM's telemetry
    };
    /// A FEM with open triggers.
    struct Fem {
        Task task;
        std::filesystem::path output;
        telemetry::Tail tail;
        int watch = -1;
        std::vector<telemetry::Line> lines = {};  ///< all so far, for triggers that come later
        std::vector<Armed> armed = {};
        bool ended = false;
        bool regular = false;  ///< takes snapshots at an interval
        bool planned = false;  ///< the run knows which tasks a firing on it makes
        std::vector<Snapshot> snapshots = {};
        std::chrono::steady_clock::time_point asked{};
        /// Of the run's stability analysis once that has come through; NaN when there is none [m].
        std::optional<double> critical_depth{};
        std::string why_no_depth = {};  ///< how the stability analysis failed; empty: it has not
        std::string trouble = {};       ///< what kept the last look from its end
    };

    void load_open_triggers();
    void look_alone(Fem& fem);
    void arm(Fem& fem, const Trigger& trigger);
    void read_on(Fem& fem);
    void feed(const Fem& fem, Armed& armed);
    void take_line(const Fem& fem, Armed& armed, const telemetry::Line& line);
    static criteria::Line line_for(const Fem& fem, const criteria::Expression& condition,
                                   const telemetry::Line& line);
    void look_for_stability(Fem& fem);
    /// It asks for the critical depth, and that is not known (yet).
    static bool lacks_depth(const Fem& fem, const Armed& armed);
    void expire_without_depth(const Fem& fem, Armed& armed);
    void settle(Fem& fem, Armed& armed);
    void settle_work(Fem& fem, Armed& armed, Manual& manual);
    void settle_work(Fem& fem, Armed& armed, When& when);
    void settle_work(Fem& fem, Armed& armed, Between& between);
    void settle_work(Fem& fem, Armed& armed, Bisect& bisect);
    /// Nothing: there is none so far.
    static const Snapshot* first_from(const Fem& fem, double wanted);
    void take_first_from(Fem& fem, Armed& armed, double wanted);
    void take(Fem& fem, Armed& armed, const Snapshot& snapshot, double wanted);
    void ask_for_snapshot(Fem& fem);
    Firing firing_of(const Fem& fem, const Armed& armed, const Snapshot& snapshot,
                     double wanted) const;
    /// Whether the condition was met, and only a snapshot, a window or the rest of its hold was missing.
    enum class WasMet { no, yes };
    void expire(Armed& armed, const std::string& why, WasMet was_met);
    /// The FEM has ended, and the condition was not met.
    void expire_unmet(const Fem& fem, Armed& armed, const criteria::Criterion& criterion);
    /// result: kept with it; null: what there is stays.
    void move(Armed& armed, TriggerEvent event, nlohmann::json detail,
              const nlohmann::json& result = nullptr);

    Store& store_;
    const DataFolder& data_;
    FolderWatch watch_;
    std::map<std::string, Fem> fems_;  ///< by task id
    std::int64_t seen_event_ = -1;
    std::chrono::steady_clock::time_point loaded_{};
};

}  // namespace breach::orchestrator
