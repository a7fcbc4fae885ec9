// The records of the store as plain data: runs, tasks, attempts, artifacts, events. No behaviour,
// no SQL.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/findings/headline.hpp"
#include "services/findings/verdict.hpp"
#include "services/orchestrator/records/lifecycle.hpp"
#include "services/orchestrator/records/trigger.hpp"

namespace breach::orchestrator {

/// Condition that releases a blocked task: an input file that exists, or a parent that succeeded.
enum class Release { at_once, file_exists, parent_succeeded };
std::string_view name_of(Release release);
Release release_named(std::string_view name);

/// Version of each phase's numerics, as the phase reports it (--version).
using Numerics = std::map<std::string, std::int64_t>;

/// All that a phase's result depends on besides its input file; equal recipes, equal results.
struct Recipe {
    std::string hash;  ///< SHA-256 of the three below
    std::string phase;
    std::int64_t cache_version;  ///< of the phase's numerics
    std::string part;            ///< the part of the completed scene that the phase reads, JSON
};

/// Resources of a task while it runs.
struct Resources {
    std::int64_t cores = 1;
    std::int64_t memory_mb = 0;
};

/// A task before it is stored: one phase execution in a study's graph.
struct TaskPlan {
    std::string phase;                    ///< executable: "fem_solver", ...
    std::string label;                    ///< unique in the run; its folder's name
    std::optional<double> transfer_time;  ///< t_T [s]; nothing where a trigger will decide it
    std::optional<std::size_t> parent;  ///< index in the plan of the task whose output is the input
    Release release = Release::at_once;
    std::string input;                   ///< file name in the parent's output folder; empty: none
    std::vector<std::string> overrides;  ///< "/json/pointer=value" beside those of the study
    std::string variant = {};            ///< empty: serves all variants
    Resources resources = {};
    std::string recipe = {};  ///< hash of one of the run's recipes; empty: never reused
};

void to_json(nlohmann::json& json, const TaskPlan& task);
void from_json(const nlohmann::json& json, TaskPlan& task);

/// "fem", "transfer_0.500000_soft": its phase, its transfer time and its variant.
std::string label_of(const TaskPlan& task);

/// Batches of samples that an uncertainty study adds while it runs. States: "open" at submission,
/// and again when a retry repeats tasks; from there BatchWatch moves it to "met" or "given_up", a
/// cancelled run to "stopped". A run with open batches is not over.
struct Batches {
    std::string run;
    nlohmann::json spec;  ///< {"batch"}, samples per batch, or {"target"}
    std::string state;
    std::string reason;  ///< why it is given up or stopped
};

/// A run before it is stored: made by http_submission from a Study, stored whole by add_run or
/// not at all.
struct NewRun {
    std::string id;
    std::string name;
    std::string title;
    std::string study;  ///< the completed study without its scene, JSON
    std::string scene;  ///< the completed scene, JSON
    std::vector<TaskPlan> tasks;
    std::vector<Recipe> recipes = {};
    std::vector<TriggerPlan> triggers = {};  ///< to be watched, on each FEM of the run
    std::vector<TaskPlan> firing_plan = {};  ///< of one more transfer (firing_plan.hpp)
    nlohmann::json batches =
        {};  ///< how more samples are added (Batches::spec); null: they are not
    std::vector<fault::Flag> warnings = {};  ///< of the study
    std::int64_t priority = 0;               ///< higher goes first
    bool sweep = false;                      ///< several points, or requested as a sweep
    std::vector<std::string> files = {};     ///< SHA-256 of stored files that its scenes name
};

/// A task that is added to a run: its parent is in the run already, or added before it.
struct AddedTask {
    TaskPlan plan;  ///< its `parent`: place in the list of added tasks
    std::optional<std::string> parent;
};

/// More transfer times, or more samples, for a run that exists.
struct Extension {
    std::vector<double> times;              ///< those that are new
    std::vector<std::string> samples = {};  ///< likewise: variants of an uncertainty study
    std::vector<AddedTask> tasks;           ///< parents first
    std::vector<Recipe> recipes;
    nlohmann::json study;                    ///< the study's document with all of them
    std::vector<fault::Flag> warnings = {};  ///< of that study
    std::vector<TaskPlan> firing_plan = {};  ///< with the new samples; empty: unchanged
    std::vector<TriggerPlan> triggers = {};  ///< for FEMs that are added
};

/// The governing result of a run (services/findings/governing.hpp).
struct GoverningResult {
    std::string task;  ///< mpm_solver, or lem_tool where it is alone
    std::string variant;
    std::optional<double> transfer_time = {};     ///< [s]
    std::optional<double> runout = {};            ///< [m]
    std::optional<findings::Soil> soil = {};      ///< its error by accuracy/runout_error.hpp
    std::optional<double> depth_beyond_toe = {};  ///< [m]
    bool lower_bound = false;
};

/// The stability analysis with the least factor of safety.
struct LeastFactor {
    std::string task;
    std::string variant;
    double factor_of_safety = 0.0;
    std::optional<double> liquefied = {};      ///< with every layer liquefied that can liquefy
    std::optional<double> after_shaking = {};  ///< least of the run's post-seismic analyses
};

struct Run {
    std::string id;
    std::string name;
    std::string title;
    /// Derived by the view run_summaries, never stored: queued running succeeded questionable
    /// partial failed cancelled.
    /// questionable: all succeeded, but a result has a flag that makes it unreliable.
    /// partial: some results are missing. A run is over when no task, trigger or batch is open.
    std::string state;
    std::string created;
    std::optional<std::string> started;
    std::optional<std::string> finished;
    std::int64_t tasks_total = 0;
    std::int64_t tasks_done = 0;    ///< succeeded or cached
    std::int64_t tasks_ended = 0;   ///< in a final state, good or bad
    std::int64_t tasks_failed = 0;  ///< failed or skipped
    std::string message;            ///< why it is not an unqualified success
    bool paused = false;            ///< no new task of it is started
    std::int64_t questionable = 0;  ///< number of unreliable results
    /// The token's name; nothing: the service needed none.
    std::optional<std::string> submitted_by = {};
    findings::Facts facts = {};  ///< the basis of its verdict
    /// Results with each flag, of the phase with the most.
    std::map<std::string, std::int64_t> flag_counts = {};
    std::optional<GoverningResult> governing = {};
    std::optional<LeastFactor> stability = {};
    bool lem_alone = false;  ///< it has stability analyses only
};

/// The MPM of a rung of an accuracy study.
struct AccuracyRung {
    std::string run;
    std::string variant;
    std::string mpm_task;
    std::string recipe;  ///< its hash
};

/// Filter for rows of a table of results: those from number `from` on that match.
struct ResultFilter {
    std::optional<std::string> state;
    std::optional<std::string> flag;  ///< a code that they carry
    std::size_t from = 0;
    std::size_t most = static_cast<std::size_t>(1) << 30;

    bool takes_all() const { return !state && !flag && from == 0 && most == ResultFilter{}.most; }
};

/// Filter for a list of runs: newest first, after the place where the last page ended.
struct RunFilter {
    std::optional<std::string> state;
    std::optional<std::string> name;
    /// A part of its name, title or id; not case-sensitive for ASCII letters.
    std::optional<std::string> search{};
    std::optional<std::pair<std::string, std::string>> before;  ///< (created, id)
    /// Only sweeps, with two more states while they run: planning (triggers will decide the
    /// transfer times) and refining (a bisection adds points after the first results).
    bool sweeps_only = false;
};

/// Why a task failed or was skipped.
struct TaskFault {
    std::optional<std::int64_t> exit_code;
    std::string summary;
};

/// Transaction::add_run, extend_run and add_transfer create it; records/lifecycle.hpp says who
/// moves it on; remove_run ends it. parent, release and input say what it waits for. recipe NULL:
/// never reused, also after the retry of a breakdown. started: the first claim; finished: set in
/// final states only, and unset by a redo.
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
    std::int64_t tries = 0;  ///< attempts that failed or were lost
    std::optional<std::string> started;
    std::optional<std::string> finished;
    std::optional<nlohmann::json> result;
    std::optional<TaskFault> fault;
    std::string variant;
    Resources resources;
    std::optional<std::string> recipe;
    std::optional<std::string> input_sha256;   ///< known once it succeeded
    std::optional<std::string> same_as;        ///< the task whose result it took
    std::optional<std::string> cache_refusal;  ///< why a fitting cache entry was not served
    std::int64_t priority = 0;
    bool not_reached = false;  ///< skipped because its FEM had regularly ended before its time
};

/// The fields of a blocked task needed for its release.
struct BlockedTask {
    std::string id;
    Release release;
    std::string input;
    std::optional<double> transfer_time;  ///< t_T [s]
};

/// One process of a task, or the intent to start one. started NULL: no sign of life was noted.
/// exit_code and signal NULL: it lives, was lost, or was stopped before its phase began.
/// wall_seconds NULL for a lost one; its cpu_seconds are those of the last heartbeat.
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

/// A file below a task's output folder, as the registrar or the cache stored it; replaced with
/// each new end of the task, deleted by a retry and with the run.
struct Artifact {
    std::string task;
    std::string name;  ///< path below the task's output folder
    std::string sha256;
    std::int64_t bytes;
};

/// Written in the transaction of the change that it reports, never changed; deleted with its run,
/// except the event of the removal itself.
struct Event {
    std::int64_t seq;
    std::string time;
    std::string run;
    std::optional<std::string> task;
    std::string kind;  ///< "run", "task", "attempt"
    nlohmann::json detail;
};

/// An uploaded file, identified by its content.
/// keep_file creates it, and every use touches it. Retention deletes it with its row when no run
/// names it and it was not used for a day; a user may do so earlier.
struct StoredFile {
    std::string sha256;
    std::string file;   ///< in the folder of stored files: the digits and the ending
    std::string name;   ///< name given by its sender
    std::string kind;   ///< "motion" or "mesh"
    std::string about;  ///< short description of its content
    std::int64_t bytes = 0;
    std::string created = {};
    std::string used = {};               ///< when it was last sent, asked for or named by a run
    std::vector<std::string> runs = {};  ///< whose scenes name it
};

/// Result of a request to remove a run or a file.
enum class Removal { done, unknown, going_on, needed };

/// A firing, and delays since the telemetry line that met its trigger [ms].
struct FiringRow {
    Firing firing;
    std::int64_t fired_ms;                 ///< to the stored firing
    std::optional<std::int64_t> start_ms;  ///< to the start of the transfer's process
};

/// A transfer with its reason and its runouts.
struct TransferRow {
    std::string task;
    std::string run;
    std::string fem_task;
    std::optional<double> transfer_time;  ///< [s]
    std::string variant;
    std::string state;
    bool not_reached;
    std::string snapshot;  ///< file name
    std::optional<std::string> fault;
    std::optional<std::string> trigger;       ///< its name; nothing: a time of the study
    std::string why;                          ///< "at_time" or the trigger's kind
    std::optional<nlohmann::json> spec;       ///< of the trigger
    std::optional<double> wanted_time;        ///< when it was met [s]
    std::optional<nlohmann::json> crossed;    ///< values on the line that met it
    std::optional<std::int64_t> fem_step;     ///< of that line
    std::optional<std::int64_t> snapshot_ms;  ///< from that line to the snapshot
    std::optional<std::int64_t> start_ms;     ///< from when the snapshot was seen to the start
    nlohmann::json runouts;                   ///< [{task, variant, state, runout}] of its MPM tasks
    std::optional<std::string> started;
    std::optional<std::string> same_as;
};

struct TransferFilter {
    std::optional<std::string> run;
    std::optional<std::string> why;
    std::optional<std::string> state;
    std::optional<std::string> before;  ///< the task where the last page ended
};

struct FactorsOfSafety {
    std::optional<double> intact;     ///< before any layer liquefies
    std::optional<double> liquefied;  ///< with every layer that can liquefy
};

/// A variant that has no transfer and will get none.
struct WithoutTransfer {
    std::string variant;
    std::string fem_task;
    std::string
        state;   ///< "not_reached": the FEM has ended, and none of its triggers has fired; else
                 ///< that of the FEM, or "cancelled"
    bool stood;  ///< no trigger's condition was met, and the mesh was valid to the end
    std::string reason;  ///< the triggers', or the FEM's
};

/// A bisection's knowledge of one transfer, from the first variant on each of its lattices.
struct Sample {
    double transfer_time;
    bool ended;                   ///< all of its runs
    std::vector<double> runouts;  ///< of the repeats that have one
    std::size_t draws;            ///< number requested; 1: the study has no repeats
    /// How a fault of the machine ended a run, so that the runout is unknown.
    std::optional<std::string> lost_by = {};
};

}  // namespace breach::orchestrator
