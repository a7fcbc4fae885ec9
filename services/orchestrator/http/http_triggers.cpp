// Triggers of a run: their states, and new ones. A new one becomes one row for each FEM that it can
// watch, in one transaction; from there TriggerWatch moves it on, on the dispatcher's thread.
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "core/scene/schema.hpp"
#include "core/telemetry/lines.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/study/draws.hpp"
#include "services/orchestrator/study/sweep_extension.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// lag_s: how much later than wanted the snapshot is, in the FEM's time. *_ms: delays since the
/// service read the line that met the trigger.
json as_json(const FiringRow& row) {
    const Firing& firing = row.firing;
    return {{"transfer_time", firing.transfer_time},
            {"wanted_time", firing.wanted_time},
            {"lag_s", firing.transfer_time - firing.wanted_time},
            {"snapshot", firing.snapshot},
            {"sha256", firing.sha256},
            {"crossed", firing.crossed},
            {"fem_step", firing.fem_step},
            {"snapshot_ms", firing.written_at - firing.noticed_at},
            {"fired_ms", row.fired_ms},
            {"start_ms", row.start_ms ? json(*row.start_ms) : json(nullptr)}};
}

json as_json(const Trigger& trigger, const std::vector<FiringRow>& firings) {
    json body{
        {"id", trigger.id},         {"name", trigger.name},
        {"kind", trigger.kind},     {"fem_task", trigger.fem_task},
        {"spec", trigger.spec},     {"state", name_of(trigger.state)},
        {"reason", trigger.reason}, {"result", trigger.result ? *trigger.result : json(nullptr)},
        {"firings", json::array()}};
    for (const FiringRow& each : firings) {
        if (each.firing.trigger == trigger.id) body["firings"].push_back(as_json(each));
    }
    return body;
}

/// Firings are read once for all triggers.
json all_of(const Service& service, const std::string& run) {
    const std::vector<FiringRow> firings = service.store.firings_of(run);
    json list = json::array();
    for (const Trigger& each : service.store.triggers_of(run))
        list.push_back(as_json(each, firings));
    return {{"run", run}, {"triggers", list}};
}

double span_of(const json& scene) {
    double span = 0.0;
    for (const json& stage : scene.at("fem").at("stages")) span += stage.value("duration", 0.0);
    return span;
}

/// A manual trigger is an order for the next snapshot: only a running FEM can follow it.
bool runs_now(const Task& fem) {
    return fem.state == TaskState::starting || fem.state == TaskState::running;
}

/// Simulated time of the last complete line.
/// The snapshot must lie after this time; the FEM goes on while the request is answered.
double reached(const DataFolder& data, const Task& fem) {
    const auto lines = telemetry::Tail(data.output(fem) / phases::files::telemetry).fresh();
    return lines.empty() ? 0.0 : lines.back().time;
}

/// The same checks as of a study's triggers, though the run is checked already: a field must exist
/// and a time lie within the FEM.
TriggerPlan checked(const Service& service, const std::string& run, const std::string& body) {
    // Uses the schema of an entry in a study's list.
    json entries = json::array({scene::parse_json(body, "trigger")});
    std::vector<fault::Fault> faults = scene::complete_and_check(
        entries, scene::study_schema().at("properties").at("triggers"), "trigger");
    if (!faults.empty()) throw fault::BadInput("trigger", std::move(faults));
    const json scene = json::parse(unless_removed(service.store.scene_of(run)));
    if (!scene.contains(phases::fem.part))
        throw Problem{409, "/problems/no-fem", "No FEM to watch", "the run's scene has no FEM"};
    const double span = span_of(scene);
    CheckedTriggers triggers = check_triggers(entries, span, "", faults);
    if (!faults.empty()) throw fault::BadInput("trigger", std::move(faults));
    // "at_time" needs snapshots that the FEM plans at its start.
    if (triggers.live.empty())
        throw bad_request("transfer times are given with the study, before its FEM starts");
    TriggerPlan plan = std::move(triggers.live.front());
    // The store then gives it a free name.
    if (!entries[0].contains("name")) plan.name.clear();
    return plan;
}

/// A shared FEM has several stability analyses, and a trigger needs one.
void check_fems(const Service& service, const std::string& run, const TriggerPlan& plan) {
    const RunSoFar so_far{.study = unless_removed(service.store.study_of(run)),
                          .scene = unless_removed(service.store.scene_of(run)),
                          .tasks = service.store.tasks_of(run)};
    if (!shares_fems_too_widely(so_far, service.data, service.numerics, plan)) return;
    throw fault::BadInput(
        "trigger",
        {{"",
          "asks for a stability analysis, and variants with different stability analyses share a "
          "FEM of this run",
          "submit the study with this trigger: such variants then have FEMs of their "
          "own"}});
}

void add(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& run = call.parts[0];
    wanted_run(service, run);
    const TriggerPlan plan = checked(service, run, call.json_body());
    const Draws draws = draws_of(unless_removed(service.store.study_of(run)));
    // Also refused at submission (conflicts.cpp).
    if (draws.of == Redrawn::fem && draws.count > 1) throw bad_request(each_fem_has_its_time);
    for (const Trigger& each : service.store.triggers_of(run)) {
        if (each.name == plan.name)
            throw Problem{409, "/problems/name-taken", "Name taken",
                          "the run has a trigger named " + plan.name};
    }
    check_fems(service, run, plan);
    std::vector<std::pair<std::string, TriggerPlan>> wanted;
    for (const Task& task : service.store.tasks_of(run)) {
        // Also FEMs that have ended: their telemetry and snapshots are there to be watched.
        if (task.phase != phases::fem.program || task.state == TaskState::cancelled) continue;
        if (plan.kind == "manual" && !runs_now(task)) continue;
        wanted.emplace_back(task.id, plan);
        if (plan.kind == "manual") wanted.back().second.spec["after"] = reached(service.data, task);
    }
    if (wanted.empty())
        throw Problem{409, "/problems/no-fem", "No FEM to watch",
                      plan.kind == "manual" ? "the run's FEM does not run now"
                                            : "the run's FEM was cancelled"};
    service.store.write(call.caller.name, [&](Transaction& transaction) {
        for (const auto& [fem, each] : wanted) transaction.add_trigger(run, fem, each);
    });
    service.dispatcher.wake();
    reply(call.response, all_of(service, run), 202);
}

}  // namespace

void add_trigger_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/triggers", [&](Call& call) {
        call.allow_parameters({});
        wanted_run(service, call.parts[0]);
        reply(call.response, all_of(service, call.parts[0]));
    });
    router.post("/v1/runs/{id}/triggers", [&](Call& call) { add(service, call); });
}

}  // namespace breach::orchestrator
