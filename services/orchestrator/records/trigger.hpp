// Triggers of transfers: their kinds, their states, and their checks when they are submitted.
// At-time triggers need no watching: they become transfer times of the study.
//
//     armed             -> holding   its condition is true (or a user asked); it waits for the hold
//                                    or for a snapshot
//     holding           -> armed     the condition was broken inside the hold
//     armed, holding    -> fired     in one transaction with its firing and its tasks; final
//     armed, holding    -> expired   the FEM ended without what it waited for
//     armed, holding    -> disarmed  the run was cancelled
//     expired, disarmed -> armed     a user's retry repeats the task that had ended it
//
// A restart evaluates the telemetry again from its first line: the stored `armed` and `holding` are
// for display, the stored `fired` is authoritative.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/criteria/window.hpp"
#include "core/fault/fault.hpp"

namespace breach::orchestrator {

enum class TriggerState { armed, holding, fired, expired, disarmed };
enum class TriggerEvent { cross, uncross, fire, expire, disarm, rearm };

std::optional<TriggerState> next(TriggerState from, TriggerEvent event);
/// Not watched any more: only a user's retry moves it.
bool is_final(TriggerState state);
std::string_view name_of(TriggerState state);
std::string_view name_of(TriggerEvent event);
TriggerState trigger_state_named(std::string_view name);

/// A trigger before it is stored.
struct TriggerPlan {
    std::string name;  ///< unique in the run (per FEM)
    std::string kind;  ///< "manual", "criterion", "window", "bisect"
    nlohmann::json spec;
};

struct Trigger {
    std::string id;
    std::string run;
    std::string fem_task;
    std::string name;
    std::string kind;
    nlohmann::json spec;
    TriggerState state;
    std::string reason;                    ///< why it expired or was disarmed
    std::optional<nlohmann::json> result;  ///< bisect: the edges
};

/// One transfer that a trigger made.
struct Firing {
    std::string trigger;
    double transfer_time;     ///< the snapshot's [s]
    double wanted_time;       ///< when the trigger was met [s]
    std::string snapshot;     ///< file name
    std::string sha256;       ///< of the snapshot
    nlohmann::json crossed;   ///< values on the line that crossed; null: nothing was measured
    std::int64_t fem_step;    ///< of that line
    std::int64_t noticed_at;  ///< when the service read the line that met it [ms since 1970]
    std::int64_t written_at;  ///< when the snapshot was written [ms since 1970]
};

// ---------------------------------------------------------------- kinds, ready to work

struct Manual {
    double after;  ///< simulated time of the request [s]
};
struct When {
    criteria::Criterion criterion;
};
struct Between {
    criteria::Window window;
    criteria::Pick pick;
};
struct Bisect {
    double share;      ///< of the largest runout: runouts above it belong to the plateau [-]
    double tolerance;  ///< of the edges [s]
    double from, to;   ///< range to search [s]
    int seeds;         ///< transfers before the first halving
    int most_runs;
};
using Work = std::variant<Manual, When, Between, Bisect>;

/// The spec is checked already.
Work work_of(const TriggerPlan& plan);

/// Names for conditions: the columns of core/telemetry.
const std::vector<std::string>& telemetry_fields();

struct CheckedTriggers {
    std::vector<TriggerPlan> live;        ///< triggers to watch
    std::vector<nlohmann::json> at_time;  ///< "times" of the at_time triggers: a list or a range
    double snapshot_interval = 0.0;       ///< for live triggers; 0: they request snapshots [s]
};

/// Checks entries that fit the schema; `span`: the dynamic stages' length [s]. Faults are added
/// below `pointer`.
CheckedTriggers check_triggers(const nlohmann::json& entries, double span,
                               const std::string& pointer, std::vector<fault::Fault>& faults);

}  // namespace breach::orchestrator
