// What the store keeps, as plain data: runs, tasks, attempts, artifacts, events. No behaviour, no
// SQL.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/lifecycle.hpp"

namespace breach::orchestrator {

/// What lets a blocked task go: an input file that exists, or a parent that succeeded.
enum class Release { at_once, file_exists, parent_succeeded };

/// A task before it is stored: one phase execution in a study's graph.
struct TaskPlan {
    std::string phase;                    ///< executable: "fem_solver", ...
    std::string label;                    ///< unique in the run; its folder's name
    std::optional<double> transfer_time;  ///< t_T [s]
    std::optional<std::size_t> parent;  ///< index in the plan of the task whose output is the input
    Release release = Release::at_once;
    std::string input;                   ///< file name in the parent's output folder; empty: none
    std::vector<std::string> overrides;  ///< "/json/pointer=value" beside those of the study
};

struct NewRun {
    std::string id;
    std::string name;
    std::string title;
    std::string study;  ///< the completed study without its scene, JSON
    std::string scene;  ///< the completed scene, JSON
    std::vector<TaskPlan> tasks;
};

struct Run {
    std::string id;
    std::string name;
    std::string title;
    std::string
        state;  ///< derived from the tasks: queued running succeeded partial failed cancelled
    std::string created;
    std::optional<std::string> started;
    std::optional<std::string> finished;
    std::int64_t tasks_total = 0;
    std::int64_t tasks_done = 0;    ///< in a final state
    std::int64_t tasks_failed = 0;  ///< failed or skipped
    std::string message;            ///< why it is not simply fine
};

/// Why a task failed or was skipped.
struct TaskFault {
    std::optional<std::int64_t> exit_code;
    std::string summary;
};

struct Task {
    std::string id;
    std::string run;
    std::string phase;
    std::string label;
    std::optional<double> transfer_time;
    TaskState state;
    std::optional<std::string> parent;
    Release release;
    std::string input;
    std::vector<std::string> overrides;
    std::int64_t tries = 0;  ///< attempts that ended by the task's own fault
    std::optional<std::string> started;
    std::optional<std::string> finished;
    std::optional<nlohmann::json> result;
    std::optional<TaskFault> fault;
};

struct Attempt {
    std::string task;
    std::int64_t number;
    AttemptState state;
    std::string created;
    std::optional<std::string> started;
    std::optional<std::string> finished;
    std::optional<std::int64_t> exit_code;
    std::optional<std::int64_t> signal;
    std::optional<double> wall_seconds;
    std::optional<double> cpu_seconds;
};

struct Artifact {
    std::string task;
    std::string name;  ///< path below the task's output folder
    std::string sha256;
    std::int64_t bytes;
};

struct Event {
    std::int64_t seq;
    std::string time;
    std::string run;
    std::optional<std::string> task;
    std::string kind;  ///< "run", "task", "attempt"
    nlohmann::json detail;
};

/// One row of the sweep's table. Numbers are absent until the runout is done.
struct SweepRow {
    double transfer_time;
    std::string state;
    std::optional<double> runout;
    std::optional<double> runout_beyond_toe;
    std::optional<double> runout_largest;
    std::optional<double> volume_ratio;
    std::optional<double> numerical_share;
    std::optional<double> cpu_seconds;
    std::string reason;
    std::string transfer_task;
    std::string mpm_task;
};

}  // namespace breach::orchestrator
