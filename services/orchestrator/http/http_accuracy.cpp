// The table of an accuracy study, computed for each request from the results so far. With
// asked_error a reader tries another requested error without a new study.
#include "services/orchestrator/accuracy/accuracy_table.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// With the run's state, since the table of a running study is not the last one.
void reply_of_run(Call& call, const Run& run, json body) {
    body["run"] = run.id;
    body["state"] = run.state;
    reply(call.response, body);
}

/// With the study's requested error, or the request's.
AccuracyTable wanted_table(const Service& service, const Call& call, const Run& run) {
    const auto asked = call.number("asked_error");
    if (asked && !(*asked > 0.0 && *asked <= 1.0))
        throw bad_request("asked_error must be above 0 and at most 1");
    auto table = accuracy_table(service.store, service.data, run.id, asked);
    if (!table)
        throw not_found("accuracy study in run " + run.id +
                        " (its study has no entry \"accuracy\")");
    return std::move(*table);
}

void accuracy(const Service& service, Call& call) {
    call.allow_parameters({"asked_error"});
    const Run run = wanted_run(service, call.parts[0]);
    reply_of_run(call, run, as_json(wanted_table(service, call, run)));
}

}  // namespace

void add_accuracy_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/accuracy", [&](Call& call) { accuracy(service, call); });
}

}  // namespace breach::orchestrator
