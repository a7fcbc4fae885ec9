// Each transfer with the reason why it was made at its time: given, asked for, or by which trigger,
// and how late it came. Newest first, in pages; of one run or of all.
#include <algorithm>
#include <array>

#include "core/words/number.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/http_submission.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::array reasons{"at_time", "manual", "criterion", "window", "bisect"};

/// The trigger's condition with its threshold, in one line.
/// In words as an author would say it; a transfer of the study's own times has no trigger.
json condition_of(const TransferRow& row) {
    if (!row.spec) return nullptr;
    const json& spec = *row.spec;
    const auto text = [&](const char* key) { return spec.value(key, std::string()); };
    const auto amount = [&](const char* key) { return words::text_of(spec.value(key, 0.0)); };
    const std::string hold =
        spec.value("hold_s", 0.0) > 0.0 ? ", held for " + amount("hold_s") + " s" : "";
    if (row.why == "criterion") return text("when") + hold;
    if (row.why == "window")
        return "from " + text("lower") + " to " +
               (text("upper").empty() ? "the end" : text("upper")) + ", " + text("pick") + hold;
    if (row.why == "manual") return "asked for at " + amount("after") + " s";
    return "runout at least " + amount("share") + " of the largest, edges to " +
           amount("tolerance_s") + " s";
}

json as_json(const TransferRow& row) {
    return {{"task", row.task},
            {"run", row.run},
            {"fem_task", row.fem_task},
            {"transfer_time", or_null(row.transfer_time)},
            {"variant", row.variant},
            {"state", row.not_reached ? "not_reached" : row.state},
            {"why", row.why},
            {"trigger", or_null(row.trigger)},
            {"condition", condition_of(row)},
            {"crossed", or_null(row.crossed)},
            {"wanted_time", or_null(row.wanted_time)},
            {"fem_step", or_null(row.fem_step)},
            {"snapshot", row.snapshot},
            {"snapshot_ms", or_null(row.snapshot_ms)},
            {"start_ms", or_null(row.start_ms)},
            {"started", or_null(row.started)},
            {"same_as", or_null(row.same_as)},
            {"fault", or_null(row.fault)},
            {"runouts", row.runouts}};
}

void list(const Service& service, Call& call, const std::optional<std::string>& run) {
    call.allow_parameters({"limit", "cursor", "why", "state"});
    const std::size_t length = wanted_length(call);
    const TransferFilter filter{.run = run,
                                .why = call.parameter("why"),
                                .state = call.parameter("state"),
                                .before = call.parameter("cursor")};
    if (filter.why && std::ranges::find(reasons, *filter.why) == reasons.end())
        throw bad_request("why must be at_time, manual, criterion, window or bisect");
    if (filter.state && std::ranges::none_of(all_task_states(), [&](TaskState each) {
            return name_of(each) == *filter.state;
        }))
        throw bad_request("state must be a state of a task");
    std::vector<TransferRow> rows = service.store.transfers_of(filter, length + 1);
    const json next = cut_to(length, rows, &TransferRow::task);
    json transfers = json::array();
    for (const TransferRow& each : rows) transfers.push_back(as_json(each));
    reply(call.response, {{"transfers", std::move(transfers)}, {"next", next}});
}

}  // namespace

void add_transfer_routes(Router& router, Service& service) {
    router.get("/v1/transfers", [&](Call& call) { list(service, call, std::nullopt); });
    router.get("/v1/runs/{id}/transfers", [&](Call& call) {
        wanted_run(service, call.parts[0]);
        list(service, call, call.parts[0]);
    });
}

}  // namespace breach::orchestrator
