// What the disk holds, and its removal by a user. Rows go in the request; folders follow on the
// thread of retention, as a large run would block the answer.
#include <filesystem>

#include "services/orchestrator/files/disk_use.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// 202 when the run is gone from the store; its files follow.
void remove_run(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& id = call.parts[0];
    const Run run = wanted_run(service, id);
    // Before the removal, while the files are there.
    const std::int64_t freed = freed_without(service.data.run(id));
    const Removal outcome = service.store.write(call.caller.name, [&](Transaction& transaction) {
        return transaction.remove_run(id, "asked for over the API");
    });
    switch (outcome) {
        case Removal::going_on:
            throw Problem{409, "/problems/going-on", "Still going on",
                          "the run is " + run.state + ": cancel it first (POST /v1/runs/" + id +
                              "/cancel, or: breach cancel " + id +
                              ") and remove it when it has ended"};
        case Removal::done:
            break;
        default:
            throw not_found("run " + id);
    }
    service.retention.wake();
    reply(call.response, {{"id", id}, {"freed_bytes", freed}}, 202);
}

/// freed_bytes: what a removal of this run alone would free; files shared with other runs stay.
json use_of(const Run& run, const RunUse& use) {
    return {{"id", run.id},
            {"name", run.name},
            {"state", run.state},
            {"created", run.created},
            {"finished", or_null(run.finished)},
            {"bytes", use.own + use.shared},
            {"shared_bytes", use.shared},
            {"freed_bytes", use.own},
            {"shared_with", use.shared_with}};
}

/// Reads every file's size: slow, not for polling.
/// From the folders, not from the store: what has no row takes up room as well.
void storage(const Service& service, Call& call) {
    call.allow_parameters({});
    const DiskUse use(service.data.runs(), service.data.files());
    const auto by_run = use.by_run();
    const std::int64_t database = service.retention.database_bytes();
    json runs = json::array();
    constexpr auto all = static_cast<std::size_t>(1) << 30;
    for (const Run& run : service.store.runs(all)) {
        const auto found = by_run.find(run.id);
        runs.push_back(use_of(run, found == by_run.end() ? RunUse{} : found->second));
    }
    std::error_code error;
    const auto space = std::filesystem::space(service.data.runs(), error);
    const RetentionSettings& settings = service.retention.settings();
    reply(call.response, {{"runs", std::move(runs)},
                          {"runs_bytes", use.bytes_of_runs()},
                          {"files_bytes", use.bytes_of_files()},
                          {"database_bytes", database},
                          {"total_bytes", use.bytes_of_runs() + use.bytes_of_files() + database},
                          {"free_bytes", error ? json() : json(space.available)},
                          // Runs without rows whose folders are not gone yet: their bytes are still
                          // in runs_bytes.
                          {"removing", service.store.removals().size()},
                          {"keep_days", or_null(settings.keep_days)},
                          {"keep_GB", or_null(settings.keep_gb)}});
}

}  // namespace

void add_storage_routes(Router& router, Service& service) {
    router.remove("/v1/runs/{id}", [&](Call& call) { remove_run(service, call); });
    router.get("/v1/storage", [&](Call& call) { storage(service, call); });
}

}  // namespace breach::orchestrator
