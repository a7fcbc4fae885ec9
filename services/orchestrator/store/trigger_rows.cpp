// Write and read operations on triggers and their firings.
#include <algorithm>

#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/records/firing_plan.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/store/views.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

const std::string selected_triggers =
    "SELECT id, run, fem_task, name, kind, spec, state, reason, result FROM triggers ";

Trigger trigger_from(const Row& row) {
    return {.id = row.text("id"),
            .run = row.text("run"),
            .fem_task = row.text("fem_task"),
            .name = row.text("name"),
            .kind = row.text("kind"),
            .spec = row.document("spec"),
            .state = trigger_state_named(row.text("state")),
            .reason = row.text("reason"),
            .result = row.optional_document("result")};
}

/// The FEMs of the same variant, including this one: a run extended by times has several. Each time
/// has one transfer, from the first FEM with its snapshot.
std::string fems_alike(const std::string& fem) {
    return R"((SELECT alike.id FROM tasks AS fem JOIN tasks AS alike ON alike.run=fem.run
    AND alike.phase=fem.phase AND alike.variant=fem.variant WHERE fem.id=)" +
           fem + ")";
}

/// Why a task was lost although its input is valid, so that a retry may succeed; nothing: it was
/// not lost.
std::optional<std::string> lost_by(TaskState state, std::optional<std::int64_t> code,
                                   const std::optional<std::string>& summary) {
    if (state == TaskState::cancelled) return "cancelled";
    const bool answers = code == static_cast<std::int64_t>(fault::ExitCode::breakdown) ||
                         code == static_cast<std::int64_t>(fault::ExitCode::bad_input);
    if (state != TaskState::failed || answers) return std::nullopt;
    return summary.value_or(std::string(name_of(state)));
}

/// Whether the trigger depends on these tasks: its FEM, the FEM's stability analyses (as in
/// Store::stability_of), and for a bisection the runouts.
bool depends_on(Connection& database, const Trigger& trigger, const std::set<std::string>& tasks) {
    const auto has = [&](const std::string& task) { return tasks.contains(task); };
    if (has(trigger.fem_task)) return true;
    for (const char* phase : {phases::lem.program, phases::post_seismic.program}) {
        const auto stability = database.text(
            R"(SELECT id FROM tasks WHERE run=?1 AND phase=?2
ORDER BY variant=(SELECT variant FROM tasks WHERE id=?3) DESC, variant='' DESC, id LIMIT 1)",
            {trigger.run, phase, trigger.fem_task});
        if (stability && has(*stability)) return true;
    }
    return trigger.kind == "bisect" &&
           std::ranges::any_of(
               database.texts(R"(SELECT mpm.id FROM tasks AS transfer JOIN tasks AS mpm
ON mpm.parent=transfer.id WHERE transfer.parent IN )" +
                                  fems_alike("?"),
                              {trigger.fem_task}),
               has);
}

struct FemOfPlan {
    std::string label;
    std::string variant;
    std::int64_t priority;
};

}  // namespace

/// Empty for runs that were stored without triggers or FEM: nothing can fire there.
std::vector<TaskPlan> firing_plan_of(Connection& database, const std::string& run) {
    const auto plan = database.text("SELECT tasks FROM firing_plans WHERE run=?", {run});
    return plan ? json::parse(*plan).get<std::vector<TaskPlan>>() : std::vector<TaskPlan>{};
}

void Transaction::add_triggers(const NewRun& run) {
    if (!run.firing_plan.empty())
        database_.change("INSERT INTO firing_plans (run, tasks) VALUES (?,?)",
                         {run.id, json(run.firing_plan).dump()});
    for (std::size_t i = 0; i < run.tasks.size(); ++i) {
        if (run.tasks[i].phase != phases::fem.program) continue;
        for (const TriggerPlan& each : run.triggers) add_trigger(run.id, task_id(run.id, i), each);
    }
    if (!run.batches.is_null())
        database_.change("INSERT INTO batches (run, spec) VALUES (?,?)",
                         {run.id, run.batches.dump()});
}

/// Adds the samples' places in tables, and their tasks where triggers have already fired.
void Transaction::add_samples(const std::string& run, const Extension& extension) {
    database_.change(
        R"(INSERT OR IGNORE INTO variants (run, name, place)
SELECT ?1, json_extract(value, '$.name'), key FROM json_each(?2, '$.variants'))",
        {run, extension.study.dump()});
    if (extension.firing_plan.empty()) return;
    database_.change("UPDATE firing_plans SET tasks=? WHERE run=?",
                     {json(extension.firing_plan).dump(), run});
    const auto fired = database_.select(
        R"(SELECT DISTINCT fem_task, transfer_time FROM firings JOIN triggers
ON triggers.id = firings.trigger WHERE triggers.run=?)",
        {run}, [](const Row& row) {
            return std::pair{row.text("fem_task"), row.real("transfer_time")};
        });
    for (const auto& [fem_task, time] : fired) add_transfer(run, fem_task, time);
}

/// Armed from the start; open_triggers() leaves it out until its FEM runs.
std::string Transaction::add_trigger(const std::string& run, const std::string& fem_task,
                                     const TriggerPlan& plan) {
    const std::int64_t number =
        database_.integer("SELECT count(*) FROM triggers WHERE run=?", {run}).value();
    const std::string id = run + "-t" + std::to_string(number);
    std::string name = plan.name;
    if (name.empty()) name = plan.kind + "_" + std::to_string(number + 1);
    const std::string now = utc_now();
    database_.change(
        R"(INSERT INTO triggers (id, run, fem_task, name, kind, spec, state, created, changed)
VALUES (?,?,?,?,?,?,'armed',?,?))",
        {id, run, fem_task, name, plan.kind, plan.spec.dump(), now, now});
    add_event(run, fem_task, "run",
              {{"event", "trigger"}, {"trigger", id}, {"name", name}, {"to", "armed"}});
    return id;
}

/// False: the trigger was disarmed or fired meanwhile, and nothing is stored.
bool Transaction::move_trigger(const Trigger& trigger, TriggerEvent event, json detail) {
    const auto from =
        database_.first("SELECT state FROM triggers WHERE id=?", {trigger.id},
                        [](const Row& row) { return trigger_state_named(row.text("state")); });
    const auto to = from ? next(*from, event) : std::nullopt;
    if (!to) return false;
    if (detail.is_null()) detail = json::object();
    database_.change(
        R"(UPDATE triggers SET state=?1, reason=?2, changed=?3,
    result=CASE WHEN ?1='armed' THEN NULL ELSE result END WHERE id=?4)",
        {std::string(name_of(*to)), detail.value("why", ""), utc_now(), trigger.id});
    detail["event"] = "trigger";
    detail["trigger"] = trigger.id;
    detail["name"] = trigger.name;
    detail["what"] = name_of(event);
    detail["from"] = name_of(*from);
    detail["to"] = name_of(*to);
    add_event(trigger.run, trigger.fem_task, "run", detail);
    return true;
}

/// One transaction for the firing and its tasks: killed before it, the trigger is still open and
/// fires again on the same snapshot. OR IGNORE: the key (trigger, time) makes a repeated firing
/// harmless.
bool Transaction::add_firing(const Trigger& trigger, const Firing& firing) {
    const auto added = database_.change(
        R"(INSERT OR IGNORE INTO firings (trigger, transfer_time, wanted_time, snapshot, sha256, crossed,
    fem_step, noticed_at, written_at, fired_at)
SELECT id,?,?,?,?,?,?,?,?,? FROM triggers WHERE id=? AND state IN ('armed', 'holding'))",
        {firing.transfer_time, firing.wanted_time, firing.snapshot, firing.sha256,
         firing.crossed.dump(), firing.fem_step, firing.noticed_at, firing.written_at, epoch_ms(),
         trigger.id});
    if (added == 0) return false;
    add_event(trigger.run, trigger.fem_task, "run",
              {{"event", "firing"},
               {"trigger", trigger.id},
               {"name", trigger.name},
               {"transfer_time", firing.transfer_time},
               {"wanted_time", firing.wanted_time},
               {"snapshot", firing.snapshot},
               {"sha256", firing.sha256},
               {"crossed", firing.crossed}});
    add_transfer(trigger.run, trigger.fem_task, firing.transfer_time);
    return true;
}

/// Shares existing transfers (of a time of the study, or another trigger on the same snapshot).
void Transaction::add_transfer(const std::string& run, const std::string& fem_task, double time) {
    const FemOfPlan fem =
        database_
            .first("SELECT label, variant, priority FROM tasks WHERE id=?", {fem_task},
                   [](const Row& row) {
                       return FemOfPlan{row.text("label"), row.text("variant"),
                                        row.integer("priority")};
                   })
            .value();
    const std::vector<TaskPlan> plan = firing_plan_of(database_, run);
    std::vector<std::string> ids(plan.size());  // empty: other variants' FEMs
    if (const auto place = place_of_fem(plan, fem.label, fem.variant)) ids[*place] = fem_task;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (!plan[i].parent) continue;
        const std::string& parent = ids[*plan[i].parent];
        if (parent.empty()) continue;
        const TaskPlan task = at_time(plan[i], time);
        if (const auto known =
                database_.text("SELECT id FROM tasks WHERE run=? AND label=?", {run, task.label})) {
            ids[i] = *known;
            continue;
        }
        ids[i] = task_id(run, static_cast<std::size_t>(next_ordinal(run)));
        // Its snapshot exists: the transfer is ready.
        const bool ready = task.release == Release::file_exists;
        insert_task(run, ids[i], task, parent, fem.priority,
                    ready ? TaskState::ready : TaskState::blocked);
    }
}

void Transaction::keep_trigger_result(const std::string& trigger, const json& result) {
    database_.change("UPDATE triggers SET result=? WHERE id=?", {result.dump(), trigger});
}

void Transaction::disarm_triggers(const std::string& run, const std::string& why) {
    const std::vector<Trigger> open = database_.select(
        selected_triggers + "WHERE run=? AND state IN ('armed', 'holding')", {run}, trigger_from);
    for (const Trigger& each : open) move_trigger(each, TriggerEvent::disarm, {{"why", why}});
}

/// A disarmed trigger always; an expired one only if a task on which its decision rests runs
/// again.
std::vector<Trigger> Transaction::triggers_to_rearm(
    const std::string& run, const std::set<std::string>& tasks_tried_again) const {
    std::vector<Trigger> found =
        database_.select(selected_triggers + "WHERE run=? AND state IN ('disarmed', 'expired')",
                         {run}, trigger_from);
    std::erase_if(found, [&](const Trigger& each) {
        return each.state == TriggerState::expired &&
               !depends_on(database_, each, tasks_tried_again);
    });
    return found;
}

// ---------------------------------------------------------------- reading

/// Those of a FEM that waits to start are left out: there is no telemetry to read.
std::vector<Trigger> Store::open_triggers() const {
    return reader()->select(
        selected_triggers +
            R"(WHERE state IN ('armed', 'holding') AND EXISTS (SELECT 1 FROM tasks WHERE tasks.id=triggers.fem_task
    AND tasks.state NOT IN ('blocked', 'ready', 'starting')) ORDER BY id)",
        {}, trigger_from);
}

bool Store::plans_transfers_of(const Task& fem) const {
    return place_of_fem(firing_plan_of(*reader(), fem.run), fem.label, fem.variant).has_value();
}

std::vector<Trigger> Store::triggers_of(const std::string& run) const {
    return reader()->select(selected_triggers + "WHERE run=? ORDER BY rowid", {run}, trigger_from);
}

std::vector<FiringRow> Store::firings_of(const std::string& run) const {
    return reader()->select(
        R"(SELECT trigger, transfer_time, wanted_time, snapshot, sha256, crossed, fem_step, noticed_at,
    snapshot_ms, fired_ms, start_ms FROM trigger_firings WHERE run=? ORDER BY trigger, noticed_at)",
        {run}, [](const Row& row) {
            const std::int64_t noticed_at = row.integer("noticed_at");
            return FiringRow{.firing = {.trigger = row.text("trigger"),
                                        .transfer_time = row.real("transfer_time"),
                                        .wanted_time = row.real("wanted_time"),
                                        .snapshot = row.text("snapshot"),
                                        .sha256 = row.text("sha256"),
                                        .crossed = row.document("crossed"),
                                        .fem_step = row.integer("fem_step"),
                                        .noticed_at = noticed_at,
                                        .written_at = noticed_at + row.integer("snapshot_ms")},
                             .fired_ms = row.integer("fired_ms"),
                             .start_ms = row.optional_integer("start_ms")};
        });
}

/// Only of the first variant at a time and its repeats: a bisection looks for one edge.
std::vector<Sample> Store::samples_of(const std::string& trigger) const {
    std::vector<Sample> found;
    std::string first;  // variant at this time
    const auto take = [&](const Row& row) {
        const double time = row.real("transfer_time");
        const std::string variant = row.text("variant");
        if (found.empty() || found.back().transfer_time != time) {
            found.push_back({time, true, {}, 0});
            first = variant;
        }
        if (variant != first) return;
        Sample& sample = found.back();
        ++sample.draws;
        const TaskState state = task_state_named(row.text("state"));
        sample.ended &= is_final(state);
        if (!sample.lost_by)
            sample.lost_by = lost_by(state, row.optional_integer("fault_exit"),
                                     row.optional_text("fault_summary"));
        if (!sample.lost_by)
            sample.lost_by = lost_by(task_state_named(row.text("transfer_state")),
                                     row.optional_integer("transfer_exit"),
                                     row.optional_text("transfer_summary"));
        if (const auto runout = row.optional_real("runout")) sample.runouts.push_back(*runout);
    };
    reader()->query(R"(SELECT firings.transfer_time AS transfer_time,
    coalesce(variants.draw_of, mpm.variant) AS variant, mpm.state AS state,
    mpm.fault_exit AS fault_exit, nullif(mpm.fault_summary, '') AS fault_summary,
    transfer.state AS transfer_state, transfer.fault_exit AS transfer_exit,
    nullif(transfer.fault_summary, '') AS transfer_summary,
    json_extract(mpm.result, '$.runout') AS runout
FROM firings JOIN triggers ON triggers.id = firings.trigger
JOIN tasks AS transfer ON transfer.parent IN )" +
                        fems_alike("triggers.fem_task") + R"( AND transfer.input = firings.snapshot
JOIN tasks AS mpm ON mpm.parent = transfer.id
LEFT JOIN variants ON variants.run = mpm.run AND variants.name = mpm.variant
WHERE firings.trigger=? ORDER BY firings.transfer_time, mpm.id)",
                    {trigger}, take);
    return found;
}

}  // namespace breach::orchestrator
