// Runs and tasks: submit, list, show, and a user's orders. Orders are one transaction each and
// then wake the dispatcher; the answer shows the state after the transaction, not after the
// processes have followed.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "core/words/number.hpp"
#include "services/orchestrator/accuracy/runout_error.hpp"
#include "services/orchestrator/dispatch/why.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/http_submission.hpp"
#include "services/orchestrator/http/results_file.hpp"
#include "services/orchestrator/records/mean_columns.hpp"
#include "services/orchestrator/records/same_results.hpp"
#include "services/orchestrator/study/sweep_extension.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Bounds the memory of one answer; a run may have many thousand tasks.
constexpr std::size_t tasks_at_once = 500;  // read and sent together

/// The tasks with their attempts and artifacts: three queries for any number of tasks.
/// Ids of one run's tasks are adjacent, so that a range of them takes one query each.
json tasks_json(const Service& service, const std::vector<Task>& tasks) {
    json list = json::array();
    if (tasks.empty()) return list;
    auto attempts = service.store.attempts_between(tasks.front().id, tasks.back().id);
    auto artifacts = service.store.artifacts_between(tasks.front().id, tasks.back().id);
    for (const Task& each : tasks)
        list.push_back(as_json(each, attempts[each.id], artifacts[each.id], service.board));
    return list;
}

json task_json(const Service& service, const Task& task) {
    return as_json(task, service.store.attempts_of(task.id), service.store.artifacts_of(task.id),
                   service.board);
}

/// 202 only when the run is on the disk.
void submit(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string id = accept_study(service, call, Ask::run);
    call.response.set_header("Location", "/v1/runs/" + id);
    reply(call.response, run_json(service, wanted_run(service, id)), 202);
}

constexpr std::array run_states{"queued",  "running", "succeeded", "questionable",
                                "partial", "failed",  "cancelled"};
constexpr std::array sweep_states{"planning", "refining"};  // in addition to those of runs

void list_runs(const Service& service, Call& call, Ask ask) {
    call.allow_parameters({"limit", "cursor", "state", "name", "search"});
    const std::size_t length = wanted_length(call);
    RunFilter filter{.state = call.parameter("state"),
                     .name = call.parameter("name"),
                     .search = call.parameter("search"),
                     .before = std::nullopt,
                     .sweeps_only = ask == Ask::sweep};
    const auto is_one_of = [&](const auto& states) {
        return std::ranges::find(states, *filter.state) != states.end();
    };
    if (filter.state && !is_one_of(run_states) && !(filter.sweeps_only && is_one_of(sweep_states)))
        throw bad_request(std::string("state must be queued, ") +
                          (filter.sweeps_only ? "planning, refining, " : "") +
                          "running, succeeded, questionable, partial, failed or cancelled");
    // The place of the last run, not a number of rows: runs that are added meanwhile shift no page.
    if (const auto cursor = call.parameter("cursor")) filter.before = place_of(*cursor);
    // One more than wanted says whether there is a next page.
    std::vector<Run> runs = service.store.runs(filter, length + 1);
    const json next =
        cut_to(length, runs, [](const Run& last) { return last.created + "~" + last.id; });
    json list = json::array();
    for (Run& each : runs) list.push_back(run_json(service, std::move(each)));
    reply(call.response, {{filter.sweeps_only ? "sweeps" : "runs", list}, {"next", next}});
}

/// Sends the tasks of a large run in parts as the reader takes them, so that memory does not grow
/// with the run. Each task has its state at the time of reading.
void send_with_tasks(const Service& service, Call& call, const json& head) {
    struct Walk {
        std::string text;       ///< to be sent before the next tasks
        std::string last = {};  ///< task that was read
    };
    auto walk = std::make_shared<Walk>(Walk{opened(head) + "\"tasks\":["});
    call.response.set_header("Cache-Control", "no-store");
    call.response.set_chunked_content_provider(
        "application/json",
        [&service, walk, id = call.parts[0]](std::size_t, httplib::DataSink& sink) {
            try {
                if (walk->text.empty()) {
                    const auto tasks = service.store.tasks_of(id, walk->last, tasks_at_once);
                    for (const json& each : tasks_json(service, tasks))
                        walk->text += (walk->text.empty() && walk->last.empty() ? "" : ",") +
                                      each.dump(-1, ' ', false, json::error_handler_t::replace);
                    if (tasks.empty()) {
                        sink.write("]}", 2);
                        sink.done();
                        return true;
                    }
                    walk->last = tasks.back().id;
                }
                // One write per call: httplib waits for the reader in between.
                const std::string part = std::exchange(walk->text, {});
                return sink.write(part.data(), part.size());
            } catch (const std::exception& error) {
                spdlog::error("{}: its tasks cannot be sent on: {}", id, error.what());
                return false;  // closes without the last chunk: the answer is visibly incomplete
            }
        });
}

/// tasks=0: without the tasks, whose number grows with the study.
void show_run(const Service& service, Call& call) {
    call.allow_parameters({"tasks"});
    const bool with_tasks = call.whole_number("tasks", 1, 0, 1) == 1;
    const std::string& id = call.parts[0];
    const Run run = wanted_run(service, id);
    json body = run_json(service, run);
    body["study"] = unless_removed(service.store.study_of(id));
    body["study"]["scene"] = json::parse(unless_removed(service.store.scene_of(id)));
    body["files"] = files_json(service, id);
    std::tie(body["computing_seconds"], body["idle_seconds"]) =
        service.store.computing_and_idle(run);
    if (!with_tasks) return reply(call.response, body);
    if (run.tasks_total > static_cast<std::int64_t>(tasks_at_once))
        return send_with_tasks(service, call, body);
    body["tasks"] = tasks_json(service, service.store.tasks_of(id));
    reply(call.response, body);
}

/// The tasks in pages, for runs with thousands.
void list_tasks(const Service& service, Call& call) {
    call.allow_parameters({"limit", "cursor"});
    wanted_run(service, call.parts[0]);
    const std::size_t length = wanted_length(call);
    auto tasks =
        service.store.tasks_of(call.parts[0], call.parameter("cursor").value_or(""), length + 1);
    const json next = cut_to(length, tasks, &Task::id);
    reply(call.response, {{"tasks", tasks_json(service, tasks)}, {"next", next}});
}

/// An order to a whole run; 404 when there is none.
template <class Order>
/// One transaction and the dispatcher's next look; what is forbidden in a run's state is no fault
/// here but has no effect.
void command_run(Service& service, Call& call, Order order) {
    call.allow_parameters({});
    const bool known = service.store.write(call.caller.name, [&](Transaction& transaction) {
        return std::invoke(order, transaction, call.parts[0]);
    });
    if (!known) throw not_found("run " + call.parts[0]);
    service.dispatcher.settle_all();
    reply(call.response, run_json(service, wanted_run(service, call.parts[0])), 202);
}

/// The dispatcher ends processes after the answer; until then the tasks are "cancelling".
void cancel(Service& service, Call& call) {
    command_run(service, call, [](Transaction& transaction, const std::string& run) {
        return transaction.cancel_run(run, "asked for over the API");
    });
}

/// The value of an entry, if the body has no other; else null.
/// Null also for what is no JSON: the caller's message then says what the body must be.
json only_entry(const Call& call, const char* name) {
    const json body = json::parse(call.json_body(), nullptr, false);
    return body.is_object() && body.size() == 1 ? body.value(name, json()) : json();
}

void set_priority(Service& service, Call& call) {
    const json priority = only_entry(call, "priority");
    if (!priority.is_number_integer() || priority < -100 || priority > 100)
        throw bad_request("the body must be {\"priority\": -100..100}");
    command_run(service, call, [&](Transaction& transaction, const std::string& run) {
        return transaction.set_priority(run, priority.get<std::int64_t>());
    });
}

/// A title is one line: 1 to 200 bytes of UTF-8 without control characters, not only spaces.
bool is_title(const json& text) {
    if (!text.is_string()) return false;
    const auto& title = text.get_ref<const std::string&>();
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    return title.size() <= 200 && title.find_first_not_of(' ') != std::string::npos &&
           std::ranges::none_of(title, is_control);
}

void rename(Service& service, Call& call) {
    const json title = only_entry(call, "title");
    if (!is_title(title))
        throw bad_request(
            "the body must be {\"title\": \"...\"}: one line of at most 200 bytes that is not "
            "empty");
    command_run(service, call, [&](Transaction& transaction, const std::string& run) {
        return transaction.rename_run(run, title.get<std::string>());
    });
}

/// `all` stands for no limit.
ResultFilter wanted_results(const Call& call) {
    constexpr std::int64_t all = std::int64_t{1} << 30;
    ResultFilter filter{.state = call.parameter("state"),
                        .flag = call.parameter("flag"),
                        .from = static_cast<std::size_t>(call.whole_number("from", 0, 0, all)),
                        .most = static_cast<std::size_t>(call.whole_number("limit", all, 1, all))};
    if (filter.state && !is_row_state(*filter.state))
        throw bad_request("state must be questionable or a state of a task");
    return filter;
}

/// Adds a row without numbers for each variant without a transfer: the CSV would omit them.
/// The JSON answer has them in "without_transfer".
void add_without_transfer(const Store& store, const std::string& run,
                          std::vector<ResultRow>& rows) {
    for (const WithoutTransfer& each : store.without_transfer(run)) {
        ResultRow row;
        for (const ResultColumn& column : result_columns()) {
            const std::string_view name = column.name;
            row.push_back(name == "variant"  ? json(each.variant)
                          : name == "state"  ? json(each.state)
                          : name == "reason" ? json(each.reason)
                                             : json());
        }
        rows.push_back(std::move(row));
    }
}

void results(const Service& service, Call& call) {
    call.allow_parameters({"format", "from", "limit", "state", "flag", "table"});
    const Run run = wanted_run(service, call.parts[0]);
    const std::string wanted = call.parameter("table").value_or("runs");
    if (wanted != "runs" && wanted != "means") throw bad_request("table must be runs or means");
    const ResultFilter filter = wanted_results(call);
    ResultTable runs{"sweep_results", result_columns(),
                     service.store.results(call.parts[0], filter)};
    ResultTable means{"sweep_means", mean_columns(), service.store.means(call.parts[0])};
    // Neighbours and repeats of a row may lie outside of a filtered page.
    std::optional<std::vector<ResultRow>> beyond_the_filter;
    const AllRows all_rows = [&]() -> const std::vector<ResultRow>& {
        if (filter.takes_all()) return runs.rows;
        if (!beyond_the_filter) beyond_the_filter = service.store.results(call.parts[0]);
        return *beyond_the_filter;
    };
    tell_runout_errors(service.store, service.data, call.parts[0], runs.rows, means.rows, all_rows);
    const ResultTable& table = wanted == "runs" ? runs : means;
    const std::string format = call.parameter("format").value_or("json");
    if (format == "csv") {
        if (wanted == "runs" && filter.takes_all())
            add_without_transfer(service.store, call.parts[0], runs.rows);
        call.response.set_content(as_csv(table.rows, table.columns), "text/csv; charset=utf-8");
        return;
    }
    if (format == "hdf5") {
        call.response.set_header("Content-Disposition",
                                 "attachment; filename=\"" +
                                     std::string(wanted == "runs" ? "results" : "means") + ".h5\"");
        call.response.set_content(
            as_hdf5(table, call.parts[0], unless_removed(service.store.scene_of(call.parts[0])),
                    service.frames, service.data.scratch()),
            "application/x-hdf5");
        return;
    }
    if (format != "json") throw bad_request("format must be json, csv or hdf5");
    reply_with_text(call.response,
                    results_text(service.store, run, runs.rows, means.rows, all_rows));
}

// ---------------------------------------------------------------- sweeps

/// A sweep is a run as a table: variants x transfer times. Both have the same id. Every run can be
/// read as a sweep; the list contains those with several points.
/// points: rows of the table of results, whose number grows with triggers and extensions.
json sweep_json(const Service& service, const Run& run) {
    const auto [points, done] = service.store.points_of(run.id);
    json body = run_json(service, run);
    body["run"] = run.id;
    body["points_total"] = points;
    body["points_done"] = done;
    return body;
}

Run wanted_sweep(const Service& service, const std::string& id) {
    auto run = service.store.sweep(id);
    if (!run) throw not_found("sweep " + id);
    return std::move(*run);
}

void submit_sweep(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string id = accept_study(service, call, Ask::sweep);
    call.response.set_header("Location", "/v1/sweeps/" + id);
    reply(call.response, sweep_json(service, wanted_sweep(service, id)), 202);
}

/// Planned outside the transaction, in which all other writers would wait. If another extension
/// came in between, UNIQUE (run, label) refuses this one, and the client repeats it.
void extend_sweep(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& id = call.parts[0];
    const Run run = wanted_sweep(service, id);
    if (run.state == "cancelled")
        throw Problem{409, "/problems/cancelled", "Cancelled",
                      "the sweep was cancelled; retry it first, or submit another"};
    const json body = json::parse(call.json_body(), nullptr, false);
    const bool samples = body.is_object() && body.contains("samples");
    if (!body.is_object() || body.size() != 1 || !(samples || body.contains("transfer_times")))
        throw bad_request(
            "the body must be {\"transfer_times\": [...] or {from, to, step}} or {\"samples\": N}");
    if (samples && (!body["samples"].is_number_unsigned() || body["samples"] < 1))
        throw bad_request("samples, the new total, must be a whole number above 0");
    const RunSoFar so_far{.study = unless_removed(service.store.study_of(id)),
                          .scene = unless_removed(service.store.scene_of(id)),
                          .tasks = service.store.tasks_of(id)};
    const Extension extension =
        samples ? plan_more_samples(so_far, service.data, service.numerics,
                                    body["samples"].get<std::size_t>(),
                                    body["samples"].get<std::size_t>())
                : plan_extension(so_far, service.data, service.numerics, body["transfer_times"]);
    // Times that are there already change nothing, and make no event.
    if (!extension.tasks.empty() || !extension.samples.empty()) {
        service.store.write(call.caller.name, [&](Transaction& transaction) {
            transaction.extend_run(id, extension);
        });
        service.dispatcher.settle_all();
    }
    json answer = sweep_json(service, wanted_sweep(service, id));
    answer["added"] = extension.times;
    answer["added_samples"] = extension.samples;
    reply(call.response, answer, 202);
}

void show_sweep(const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_sweep(service, call.parts[0]);
    json body = sweep_json(service, run);
    const json study = unless_removed(service.store.study_of(run.id));
    body["transfer_times"] = study.value("transfer_times", json::array());
    body["variants"] = study.value("variants", json::array());
    reply(call.response, body);
}

}  // namespace

Task wanted_task(const Service& service, const std::string& id) {
    auto task = service.store.task(id);
    if (!task) throw not_found("task " + id);
    return std::move(*task);
}

json run_json(const Service& service, Run run) {
    tell_governing_error(service.store, service.data, run);
    return as_json(run, service.store, service.board);
}

Run wanted_run(const Service& service, const std::string& id) {
    auto run = service.store.run(id);
    if (!run) throw not_found("run " + id);
    return std::move(*run);
}

void add_run_routes(Router& router, Service& service) {
    router.post("/v1/sweeps", [&](Call& call) { submit_sweep(service, call); });
    router.get("/v1/sweeps", [&](Call& call) { list_runs(service, call, Ask::sweep); });
    router.get("/v1/sweeps/{id}", [&](Call& call) { show_sweep(service, call); });
    router.get("/v1/sweeps/{id}/results", [&](Call& call) {
        wanted_sweep(service, call.parts[0]);
        results(service, call);
    });
    router.post("/v1/sweeps/{id}/extend", [&](Call& call) { extend_sweep(service, call); });
    router.post("/v1/sweeps/{id}/cancel", [&](Call& call) {
        wanted_sweep(service, call.parts[0]);
        cancel(service, call);
    });
    router.post("/v1/runs", [&](Call& call) { submit(service, call); });
    router.get("/v1/runs", [&](Call& call) { list_runs(service, call, Ask::run); });
    router.get("/v1/runs/{id}/tasks", [&](Call& call) { list_tasks(service, call); });
    router.get("/v1/runs/{id}", [&](Call& call) { show_run(service, call); });
    router.post("/v1/runs/{id}/cancel", [&](Call& call) { cancel(service, call); });
    router.post("/v1/runs/{id}/pause",
                [&](Call& call) { command_run(service, call, &Transaction::pause_run); });
    router.post("/v1/runs/{id}/resume",
                [&](Call& call) { command_run(service, call, &Transaction::resume_run); });
    router.post("/v1/runs/{id}/retry", [&](Call& call) {
        command_run(service, call, [](Transaction& transaction, const std::string& run) {
            return transaction.retry_run(run).has_value();
        });
    });
    router.post("/v1/runs/{id}/priority", [&](Call& call) { set_priority(service, call); });
    router.post("/v1/runs/{id}/title", [&](Call& call) { rename(service, call); });
    router.get("/v1/runs/{id}/results", [&](Call& call) { results(service, call); });
    router.get("/v1/tasks/{id}", [&](Call& call) {
        call.allow_parameters({});
        const Task task = wanted_task(service, call.parts[0]);
        json body = task_json(service, task);
        body["why"] = why_it_ran(service.store, task);
        reply(call.response, body);
    });
}

}  // namespace breach::orchestrator
