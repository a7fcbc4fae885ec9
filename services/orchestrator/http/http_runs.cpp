#include "services/orchestrator/answers.hpp"
#include "services/orchestrator/graph.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::size_t longest_list = 500;

json run_json(const Service& service, const std::string& id) {
    return as_json(wanted_run(service, id), service.board);
}

json task_json(const Service& service, const Task& task) {
    return as_json(task, service.store.attempts_of(task.id), service.store.artifacts_of(task.id),
                   service.board);
}

/// 202 only when the run is on the disk.
void submit(Service& service, Call& call) {
    call.allow_parameters({});
    const Study study = read_study(call.json_body());
    const NewRun run{.id = new_run_id(),
                     .name = study.name,
                     .title = study.title,
                     .study = study.document.dump(),
                     .scene = study.scene.dump(),
                     .tasks = plan_tasks(study)};
    service.store.write([&](Transaction& transaction) { transaction.add_run(run); });
    service.dispatcher.wake();
    call.response.set_header("Location", "/v1/runs/" + run.id);
    reply(call.response, run_json(service, run.id), 202);
}

void list(const Service& service, Call& call) {
    call.allow_parameters({"limit"});
    const auto limit = call.whole_number("limit", 100, 1, longest_list);
    json runs = json::array();
    for (const Run& each : service.store.runs(static_cast<std::size_t>(limit)))
        runs.push_back(as_json(each, service.board));
    reply(call.response, {{"runs", runs}});
}

void show(const Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& id = call.parts[0];
    json body = run_json(service, id);
    body["study"] = *service.store.study_of(id);
    body["study"]["scene"] = json::parse(*service.store.scene_of(id));
    body["tasks"] = json::array();
    for (const Task& each : service.store.tasks_of(id))
        body["tasks"].push_back(task_json(service, each));
    reply(call.response, body);
}

void cancel(Service& service, Call& call) {
    call.allow_parameters({});
    bool known = false;
    service.store.write([&](Transaction& transaction) {
        known = transaction.cancel_run(call.parts[0], "asked for over the API");
    });
    if (!known) throw not_found("run " + call.parts[0]);
    service.dispatcher.wake();
    reply(call.response, run_json(service, call.parts[0]), 202);
}

void results(const Service& service, Call& call) {
    call.allow_parameters({"format"});
    wanted_run(service, call.parts[0]);
    const std::vector<SweepRow> rows = service.store.results(call.parts[0]);
    const std::string format = call.parameter("format").value_or("json");
    if (format == "csv") {
        call.response.set_content(as_csv(rows), "text/csv; charset=utf-8");
        return;
    }
    if (format != "json") throw bad_request("format must be json or csv");
    json list = json::array();
    for (const SweepRow& each : rows) list.push_back(as_json(each));
    reply(call.response, {{"run", call.parts[0]}, {"rows", list}});
}

}  // namespace

Task wanted_task(const Service& service, const std::string& id) {
    auto task = service.store.task(id);
    if (!task) throw not_found("task " + id);
    return std::move(*task);
}

Run wanted_run(const Service& service, const std::string& id) {
    auto run = service.store.run(id);
    if (!run) throw not_found("run " + id);
    return std::move(*run);
}

void add_run_routes(Router& router, Service& service) {
    router.post("/v1/runs", [&](Call& call) { submit(service, call); });
    router.get("/v1/runs", [&](Call& call) { list(service, call); });
    router.get("/v1/runs/{id}", [&](Call& call) { show(service, call); });
    router.post("/v1/runs/{id}/cancel", [&](Call& call) { cancel(service, call); });
    router.get("/v1/runs/{id}/results", [&](Call& call) { results(service, call); });
    router.get("/v1/tasks/{id}", [&](Call& call) {
        call.allow_parameters({});
        reply(call.response, task_json(service, wanted_task(service, call.parts[0])));
    });
}

}  // namespace breach::orchestrator
