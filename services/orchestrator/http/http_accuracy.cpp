#include "core/statistics/repeats.hpp"
#include "services/orchestrator/accuracy/accuracy_table.hpp"
#include "services/orchestrator/accuracy/blind_check.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/http_submission.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

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

std::optional<std::size_t> count_in(const Call& call, const std::string& name, std::int64_t most) {
    if (!call.parameter(name)) return std::nullopt;
    return static_cast<std::size_t>(call.whole_number(name, 1, 1, most));
}

/// Starts a run with new repeats of the recommended or the named setting.
void draw_check(Service& service, Call& call) {
    call.allow_parameters({"repeats", "ladder", "step", "mean_of", "asked_error"});
    const Run run = wanted_run(service, call.parts[0]);
    CheckRequest request;
    request.repeats = count_in(call, "repeats", most_repeats_of_a_check).value_or(request.repeats);
    request.ladder = call.parameter("ladder");
    request.step = count_in(call, "step", most_repeats_of_a_check);
    request.mean_of = count_in(call, "mean_of", statistics::most_draws_of_a_mean);
    const AccuracyTable table = wanted_table(service, call, run);
    const std::string check =
        accept_made_study(service, call, study_of_check(service.store, run.id, table, request));
    call.response.set_header("Location", "/v1/runs/" + check);
    reply(call.response, run_json(service, wanted_run(service, check)), 202);
}

/// The result of a blind check so far.
void show_check(const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_run(service, call.parts[0]);
    const auto check = blind_check(service.store, service.data, run.id);
    if (!check)
        throw not_found("blind check in run " + run.id + " (its study has no entry \"check\")");
    reply_of_run(call, run, as_json(*check));
}

}  // namespace

void add_accuracy_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/accuracy", [&](Call& call) { accuracy(service, call); });
    router.get("/v1/runs/{id}/accuracy/check", [&](Call& call) { show_check(service, call); });
    router.post("/v1/runs/{id}/accuracy/check", [&](Call& call) { draw_check(service, call); });
}

}  // namespace breach::orchestrator
