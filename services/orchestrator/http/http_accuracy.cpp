#include "services/orchestrator/accuracy/accuracy_table.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The table of an accuracy study, as far as the run has come.
void accuracy(const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_run(service, call.parts[0]);
    const auto table = accuracy_table(service.store, service.data, run.id);
    if (!table)
        throw not_found("accuracy study in run " + run.id +
                        " (its study has no entry \"accuracy\")");
    json body = as_json(*table);
    body["run"] = run.id;
    body["state"] = run.state;
    reply(call.response, body);
}

}  // namespace

void add_accuracy_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/accuracy", [&](Call& call) { accuracy(service, call); });
}

}  // namespace breach::orchestrator
