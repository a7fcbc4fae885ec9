// Triggers and their firings in the store: the writing and the reading half.
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

constexpr const char* trigger_columns =
    "SELECT id, run, fem_task, name, kind, spec, state, reason, result FROM triggers ";

Trigger trigger_from(const Row& row) {
    Trigger trigger{.id = row.text(0),
                    .run = row.text(1),
                    .fem_task = row.text(2),
                    .name = row.text(3),
                    .kind = row.text(4),
                    .spec = json::parse(row.text(5)),
                    .state = trigger_state_named(row.text(6)),
                    .reason = row.text(7),
                    .result = std::nullopt};
    if (!row.is_null(8)) trigger.result = json::parse(row.text(8));
    return trigger;
}

/// The FEMs of the same variant, that one included: a run extended by times has several, and one
/// transfer at each time, behind the first that has its snapshot.
std::string fems_alike(const std::string& fem) {
    return "(SELECT alike.id FROM tasks AS fem JOIN tasks AS alike ON alike.run=fem.run AND "
           "alike.phase=fem.phase AND alike.variant=fem.variant WHERE fem.id=" +
           fem + ")";
}

/// A task's state, exit code and summary, from this column on: how it was lost, which no input can
/// help and a retry may mend. Nothing: it was not.
std::optional<std::string> lost_by(const Row& row, int column) {
    const TaskState state = task_state_named(row.text(column));
    if (state == TaskState::cancelled) return "cancelled";
    if (state != TaskState::failed) return std::nullopt;
    const auto code = row.optional_integer(column + 1).value_or(0);
    const bool answers = code == static_cast<std::int64_t>(fault::ExitCode::breakdown) ||
                         code == static_cast<std::int64_t>(fault::ExitCode::bad_input);
    if (answers) return std::nullopt;
    const std::string summary = row.text(column + 2);
    return summary.empty() ? std::string(name_of(state)) : summary;
}

}  // namespace

void Transaction::add_triggers(const NewRun& run) {
    if (!run.firing_plan.empty())
        database_.change("INSERT INTO firing_plans (run, tasks) VALUES (?,?)",
                         {run.id, json(run.firing_plan).dump()});
    for (std::size_t i = 0; i < run.tasks.size(); ++i) {
        if (run.tasks[i].phase != phases::fem.program) continue;
        for (const TriggerPlan& each : run.triggers) add_trigger(run.id, task_id(run.id, i), each);
    }
    if (run.batches && !run.tasks.empty()) add_trigger(run.id, task_id(run.id, 0), *run.batches);
}

/// Their places in tables, and their tasks where triggers have fired already.
void Transaction::add_samples(const std::string& run, const Extension& extension) {
    database_.change(
        "INSERT OR IGNORE INTO variants (run, name, place) SELECT ?1, json_extract(value, "
        "'$.name'), key FROM json_each(?2, '$.variants')",
        {run, extension.study.dump()});
    if (extension.firing_plan.empty()) return;
    database_.change("UPDATE firing_plans SET tasks=? WHERE run=?",
                     {json(extension.firing_plan).dump(), run});
    std::vector<std::pair<std::string, double>> fired;
    database_.query(
        "SELECT DISTINCT triggers.fem_task, firings.transfer_time FROM firings JOIN triggers ON "
        "triggers.id = firings.trigger WHERE triggers.run=?",
        {run}, [&](const Row& row) { fired.emplace_back(row.text(0), row.real(1)); });
    for (const auto& [fem_task, time] : fired) add_transfer(run, fem_task, time);
}

bool Transaction::is_open(const std::string& trigger) const {
    bool open = false;
    database_.query("SELECT 1 FROM triggers WHERE id=? AND state IN ('armed', 'holding')",
                    {trigger}, [&](const Row&) { open = true; });
    return open;
}

std::string Transaction::add_trigger(const std::string& run, const std::string& fem_task,
                                     const TriggerPlan& plan) {
    std::int64_t number = 0;
    database_.query("SELECT count(*) FROM triggers WHERE run=?", {run},
                    [&](const Row& row) { number = row.integer(0); });
    const std::string id = run + "-t" + std::to_string(number);
    std::string name = plan.name;
    if (name.empty()) name = plan.kind + "_" + std::to_string(number + 1);
    const std::string now = utc_now();
    database_.change(
        "INSERT INTO triggers (id, run, fem_task, name, kind, spec, state, created, changed) "
        "VALUES (?,?,?,?,?,?,'armed',?,?)",
        {id, run, fem_task, name, plan.kind, plan.spec.dump(), now, now});
    add_event(run, fem_task, "run",
              {{"event", "trigger"}, {"trigger", id}, {"name", name}, {"to", "armed"}});
    return id;
}

bool Transaction::move_trigger(const Trigger& trigger, TriggerEvent event, json detail) {
    std::optional<TriggerState> from;
    database_.query("SELECT state FROM triggers WHERE id=?", {trigger.id},
                    [&](const Row& row) { from = trigger_state_named(row.text(0)); });
    const auto to = from ? next(*from, event) : std::nullopt;
    if (!to) return false;
    if (detail.is_null()) detail = json::object();
    database_.change(
        "UPDATE triggers SET state=?1, reason=?2, changed=?3, "
        "result=CASE WHEN ?1='armed' THEN NULL ELSE result END WHERE id=?4",
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

bool Transaction::add_firing(const Trigger& trigger, const Firing& firing) {
    const auto added = database_.change(
        "INSERT OR IGNORE INTO firings (trigger, transfer_time, wanted_time, snapshot, sha256, "
        "crossed, fem_step, noticed_at, written_at, fired_at) SELECT id,?,?,?,?,?,?,?,?,? FROM "
        "triggers WHERE id=? AND state IN ('armed', 'holding')",
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

/// What is there already (an at-time transfer, another trigger on the same snapshot) is shared.
void Transaction::add_transfer(const std::string& run, const std::string& fem_task, double time) {
    std::vector<TaskPlan> plan;
    std::string label, variant;
    std::int64_t priority = 0;
    database_.query(
        "SELECT firing_plans.tasks, tasks.label, tasks.variant, tasks.priority FROM tasks JOIN "
        "firing_plans ON firing_plans.run = tasks.run WHERE tasks.id=?",
        {fem_task}, [&](const Row& row) {
            plan = read_firing_plan(json::parse(row.text(0)));
            label = row.text(1);
            variant = row.text(2);
            priority = row.integer(3);
        });
    std::vector<std::string> ids(plan.size());  // empty: of another variant's FEM
    if (const auto fem = place_of_fem(plan, label, variant)) ids[*fem] = fem_task;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (!plan[i].parent) continue;
        const std::string& parent = ids[*plan[i].parent];
        if (parent.empty()) continue;
        const TaskPlan task = at_time(plan[i], time);
        database_.query("SELECT id FROM tasks WHERE run=? AND label=?", {run, task.label},
                        [&](const Row& row) { ids[i] = row.text(0); });
        if (ids[i].empty()) ids[i] = add_fired_task(run, task, parent, priority);
    }
}

std::string Transaction::add_fired_task(const std::string& run, const TaskPlan& task,
                                        const std::string& parent, std::int64_t priority) {
    std::string id = task_id(run, static_cast<std::size_t>(next_ordinal(run)));
    // Its snapshot exists: a transfer has nothing to wait for.
    const bool ready = task.release == Release::file_exists;
    insert_task(run, id, task, parent, priority, ready ? TaskState::ready : TaskState::blocked);
    return id;
}

void Transaction::keep_trigger_result(const std::string& trigger, const json& result) {
    database_.change("UPDATE triggers SET result=? WHERE id=?", {result.dump(), trigger});
}

void Transaction::disarm_triggers(const std::string& run, const std::string& why) {
    std::vector<Trigger> open;
    database_.query(std::string(trigger_columns) + "WHERE run=? AND state IN ('armed', 'holding')",
                    {run}, [&](const Row& row) { open.push_back(trigger_from(row)); });
    for (const Trigger& each : open) move_trigger(each, TriggerEvent::disarm, {{"why", why}});
}

std::vector<Trigger> Transaction::triggers_to_rearm(
    const std::string& run, const std::set<std::string>& tasks_tried_again) const {
    std::vector<Trigger> found;
    database_.query(
        std::string(trigger_columns) + "WHERE run=? AND state IN ('disarmed', 'expired')", {run},
        [&](const Row& row) { found.push_back(trigger_from(row)); });
    std::erase_if(found, [&](const Trigger& each) {
        return each.state == TriggerState::expired && !hangs_on(each, tasks_tried_again);
    });
    return found;
}

/// What it decides by: its FEM, that one's stability analysis (as Store::stability_of has it), and for
/// a bisect the runouts.
bool Transaction::hangs_on(const Trigger& trigger, const std::set<std::string>& tasks) const {
    bool found = tasks.contains(trigger.fem_task);
    const auto note = [&](const Row& row) { found |= tasks.contains(row.text(0)); };
    database_.query(
        "SELECT id FROM tasks WHERE run=?1 AND phase=?2 ORDER BY variant=(SELECT variant FROM "
        "tasks "
        "WHERE id=?3) DESC, variant='' DESC, id LIMIT 1",
        {trigger.run, phases::lem.program, trigger.fem_task}, note);
    if (trigger.kind == "bisect")
        database_.query(
            "SELECT mpm.id FROM tasks AS transfer JOIN tasks AS mpm ON mpm.parent=transfer.id "
            "WHERE transfer.parent IN " +
                fems_alike("?"),
            {trigger.fem_task}, note);
    return found;
}

// ---------------------------------------------------------------- reading

std::vector<Trigger> Store::open_triggers() const {
    std::vector<Trigger> found;
    read([&](Connection& database) {
        database.query(std::string(trigger_columns) +
                           "WHERE state IN ('armed', 'holding') AND NOT (" + draws_samples("spec") +
                           ") AND EXISTS (SELECT 1 FROM tasks WHERE tasks.id=triggers.fem_task AND "
                           "tasks.state NOT IN ('blocked', 'ready', 'starting')) ORDER BY id",
                       {}, [&](const Row& row) { found.push_back(trigger_from(row)); });
    });
    return found;
}

bool Store::plans_transfers_of(const Task& fem) const {
    bool planned = false;
    read([&](Connection& database) {
        database.query("SELECT tasks FROM firing_plans WHERE run=?", {fem.run},
                       [&](const Row& row) {
                           const auto plan = read_firing_plan(json::parse(row.text(0)));
                           planned = place_of_fem(plan, fem.label, fem.variant).has_value();
                       });
    });
    return planned;
}

std::vector<Trigger> Store::open_batches() const {
    std::vector<Trigger> found;
    read([&](Connection& database) {
        database.query(std::string(trigger_columns) + "WHERE state IN ('armed', 'holding') AND " +
                           draws_samples("spec") + " ORDER BY id",
                       {}, [&](const Row& row) { found.push_back(trigger_from(row)); });
    });
    return found;
}

std::vector<Trigger> Store::triggers_of(const std::string& run) const {
    std::vector<Trigger> found;
    read([&](Connection& database) {
        database.query(std::string(trigger_columns) + "WHERE run=? ORDER BY rowid", {run},
                       [&](const Row& row) { found.push_back(trigger_from(row)); });
    });
    return found;
}

std::vector<FiringRow> Store::firings_of(const std::string& run) const {
    std::vector<FiringRow> found;
    read([&](Connection& database) {
        database.query(
            "SELECT trigger, transfer_time, wanted_time, snapshot, sha256, crossed, fem_step, "
            "noticed_at, snapshot_ms, fired_ms, start_ms FROM trigger_firings WHERE run=? ORDER BY "
            "trigger, noticed_at",
            {run}, [&](const Row& row) {
                FiringRow each{.firing = {.trigger = row.text(0),
                                          .transfer_time = row.real(1),
                                          .wanted_time = row.real(2),
                                          .snapshot = row.text(3),
                                          .sha256 = row.text(4),
                                          .crossed = json::parse(row.text(5)),
                                          .fem_step = row.integer(6),
                                          .noticed_at = row.integer(7),
                                          .written_at = row.integer(7) + row.integer(8)},
                               .fired_ms = row.integer(9),
                               .start_ms = row.optional_integer(10)};
                found.push_back(std::move(each));
            });
    });
    return found;
}

std::vector<Sample> Store::samples_of(const std::string& trigger) const {
    std::vector<Sample> found;
    std::string first;  // variant at this time
    read([&](Connection& database) {
        database.query(
            "SELECT firings.transfer_time, coalesce(variants.draw_of, mpm.variant), mpm.state, "
            "mpm.fault_exit, coalesce(mpm.fault_summary, ''), transfer.state, "
            "transfer.fault_exit, coalesce(transfer.fault_summary, ''), "
            "json_extract(mpm.result, '$.runout') FROM firings JOIN triggers ON triggers.id = "
            "firings.trigger JOIN tasks AS transfer ON transfer.parent IN " +
                fems_alike("triggers.fem_task") +
                " AND transfer.input = firings.snapshot JOIN tasks AS mpm ON mpm.parent = "
                "transfer.id LEFT JOIN variants ON variants.run = mpm.run AND variants.name = "
                "mpm.variant WHERE firings.trigger=? ORDER BY firings.transfer_time, mpm.id",
            {trigger}, [&](const Row& row) {
                if (found.empty() || found.back().transfer_time != row.real(0)) {
                    found.push_back({row.real(0), true, {}, 0});
                    first = row.text(1);
                }
                if (row.text(1) != first) return;
                Sample& sample = found.back();
                ++sample.draws;
                sample.ended &= is_final(task_state_named(row.text(2)));
                for (const int task : {2, 5})
                    if (!sample.lost_by) sample.lost_by = lost_by(row, task);
                if (const auto runout = row.optional_real(8)) sample.runouts.push_back(*runout);
            });
    });
    return found;
}

}  // namespace breach::orchestrator
