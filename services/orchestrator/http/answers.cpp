// JSON of records, for all routes: one place, so that a run looks the same in a list, in an
// answer to an order and in its own page. null means not known or not applicable.
#include "services/orchestrator/http/answers.hpp"

#include "core/exchange/csv.hpp"
#include "services/findings/flags.hpp"
#include "services/findings/headline.hpp"
#include "services/orchestrator/records/mean_columns.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/records/same_results.hpp"
#include "services/orchestrator/records/time_left.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

json as_json(const Attempt& attempt) {
    return {{"number", attempt.number},
            {"state", name_of(attempt.state)},
            {"started", or_null(attempt.started)},
            {"finished", or_null(attempt.finished)},
            {"exit_code", or_null(attempt.exit_code)},
            {"signal", or_null(attempt.signal)},
            {"wall_seconds", or_null(attempt.wall_seconds)},
            {"cpu_seconds", or_null(attempt.cpu_seconds)}};
}

/// An entry of the task's result; null: no result, or no such entry.
/// A few entries of result.json stand at the top of a task, where lists of tasks show them.
json of_result(const Task& task, const char* key) {
    return task.result && task.result->is_object() ? task.result->value(key, json()) : json();
}

/// farthest differs from runout for a dam whose soil stays short of the toe: negative, upstream.
json as_json(const GoverningResult& governing) {
    return {{"task", governing.task},
            {"variant", governing.variant},
            {"transfer_time", or_null(governing.transfer_time)},
            {"runout", or_null(governing.runout)},
            {"farthest", governing.soil ? json(governing.soil->farthest) : json()},
            {"error", governing.soil ? or_null(governing.soil->error) : json()},
            {"lower_bound", governing.lower_bound},
            {"depth_beyond_toe", or_null(governing.depth_beyond_toe)}};
}

json as_json(const LeastFactor& least) {
    return {{"task", least.task},
            {"variant", least.variant},
            {"factor_of_safety", least.factor_of_safety},
            {"factor_of_safety_liquefied", or_null(least.liquefied)},
            {"factor_of_safety_post_seismic", or_null(least.after_shaking)}};
}

/// Only where no FEM of the run made a runout may "stood" be said of the dam.
findings::Headline headline_of(const Run& run) {
    findings::HeadlineFacts facts{
        .stood_in_fem =
            !run.facts.has_runout && !run.facts.without_transfer.empty() &&
            std::ranges::all_of(run.facts.without_transfer, &findings::NoTransfer::stood),
        .lem_alone = run.lem_alone};
    if (run.governing) facts.soil = run.governing->soil;
    if (run.stability) {
        facts.factor_of_safety = run.stability->factor_of_safety;
        facts.factor_of_safety_liquefied = run.stability->liquefied;
        facts.factor_of_safety_post_seismic = run.stability->after_shaking;
    }
    return findings::headline_of(facts);
}

/// Every column may be null: rows exist before their tasks have ended.
json schema_of(ColumnKind kind) {
    switch (kind) {
        case ColumnKind::number:
            return {{"type", {"number", "null"}}};
        case ColumnKind::yes_no:
            return {{"type", {"boolean", "null"}}};
        case ColumnKind::word:
            return {{"type", {"string", "null"}}};
        case ColumnKind::flags:
            return {{"type", {"array", "null"}},
                    {"items", {{"$ref", "#/components/schemas/FlagOfRow"}}}};
    }
    return nullptr;
}

}  // namespace

json as_json(const Run& run, const Store& store, const ProgressBoard& board) {
    // Progress of running tasks is on the board only, never in the store: it changes too often.
    const double fractions = board.sum_of_run(run.id);
    double progress = 1.0;
    if (!run.finished && run.tasks_total > 0) {
        progress = (static_cast<double>(run.tasks_ended) + fractions) /
                   static_cast<double>(run.tasks_total);
    }
    // A paused run has no time left to tell: it depends on when someone resumes it.
    const bool goes_on = run.started && !run.finished && !run.paused;
    std::optional<double> left;
    if (goes_on) left = time_left(store.left_of(run.id), fractions);
    return {{"id", run.id},
            {"name", run.name},
            {"title", run.title},
            {"state", run.state},
            {"created", run.created},
            {"started", or_null(run.started)},
            {"finished", or_null(run.finished)},
            {"progress", board.never_back(run.id, progress)},
            {"tasks_total", run.tasks_total},
            {"tasks_done", run.tasks_done},
            {"tasks_failed", run.tasks_failed},
            {"paused", run.paused},
            {"submitted_by", or_null(run.submitted_by)},
            {"seconds_left", or_null(left)},
            {"questionable", run.questionable},
            {"flag_counts", run.flag_counts},
            {"warnings", fault::as_json(run.facts.submitted)},
            {"headline", findings::as_json(headline_of(run))},
            {"verdict", findings::as_json(findings::verdict_of(run.facts))},
            {"governing", run.governing ? as_json(*run.governing) : json()},
            {"stability", run.stability ? as_json(*run.stability) : json()},
            {"message", run.message}};
}

json as_json(const Task& task, const std::vector<Attempt>& attempts,
             const std::vector<Artifact>& artifacts, const ProgressBoard& board) {
    Progress progress = board.of(task.id);
    // The board forgets a task that has ended.
    if (is_final(task.state)) progress.fraction = 1.0;
    json tried = json::array();
    for (const Attempt& each : attempts) tried.push_back(as_json(each));
    json kept = json::array();
    for (const Artifact& each : artifacts)
        kept.push_back({{"name", each.name}, {"sha256", each.sha256}, {"bytes", each.bytes}});
    json fault = nullptr;
    if (task.fault)
        // Without pointers and remedies: those are in the task's fault.json.
        fault = {{"exit_code", or_null(task.fault->exit_code)}, {"summary", task.fault->summary}};
    return {
        {"id", task.id},
        {"run", task.run},
        {"phase", task.phase},
        {"label", task.label},
        {"transfer_time", or_null(task.transfer_time)},
        {"variant", task.variant},
        {"state", name_of(task.state)},
        {"progress", progress.fraction},
        {"message", progress.message},
        {"started", or_null(task.started)},
        {"finished", or_null(task.finished)},
        {"result", or_null(task.result)},
        {"ended", of_result(task, "ended")},
        {"end_time", of_result(task, "end_time")},
        {"questionable", of_result(task, "questionable")},
        {"flags", of_result(task, "flags")},
        {"fault", fault},
        {"not_reached", task.not_reached},
        {"same_as", or_null(task.same_as)},
        {"priority", task.priority},
        {"resources", {{"cores", task.resources.cores}, {"memory_MB", task.resources.memory_mb}}},
        {"attempts", tried},
        {"artifacts", kept}};
}

json as_json(const Event& event) {
    return {{"seq", event.seq},   {"time", event.time},
            {"run", event.run},   {"task", or_null(event.task)},
            {"kind", event.kind}, {"detail", event.detail}};
}

namespace {

/// A table of results may have thousands of rows, all of them in one answer.
void append_value(std::string& text, const json& value) {
    const auto is_plain = [](unsigned char c) {
        return c >= 0x20 && c < 0x7f && c != '"' && c != '\\';
    };
    if (value.is_null()) {
        text += "null";
    } else if (value.is_boolean()) {
        text += value.get<bool>() ? "true" : "false";
    } else if (value.is_string() &&
               std::ranges::all_of(value.get_ref<const std::string&>(), is_plain)) {
        text.append(1, '"').append(value.get_ref<const std::string&>()).append(1, '"');
    } else {
        text += value.dump(-1, ' ', false, json::error_handler_t::replace);
    }
}

}  // namespace

std::string as_json_text(const std::vector<ResultRow>& rows, Columns columns) {
    std::vector<std::string> before;  // "name": before the value of each column
    for (const ResultColumn& each : columns)
        before.push_back((before.empty() ? "{" : ",") + json(each.name).dump() + ":");
    std::string text = "[";
    for (const ResultRow& row : rows) {
        if (text.size() > 1) text += ",";
        for (std::size_t i = 0; i < row.size(); ++i) append_value(text += before[i], row[i]);
        text += "}";
    }
    return text + "]";
}

json described(Columns columns) {
    json list = json::array();
    for (const ResultColumn& each : columns) {
        list.push_back({{"name", each.name},
                        {"kind", name_of(each.kind)},
                        {"unit", each.unit},
                        {"title", each.title},
                        {"meaning", each.meaning},
                        {"grows", findings::grows(each.name)}});
    }
    return list;
}

namespace {

/// Among the study's own variants, without repeats.
/// Repeats differ by noise alone and would never be equal, so only the author's variants count.
json same_results_of(const Store& store, const std::string& run, const AllRows& all_rows) {
    std::vector<std::string> variants;
    for (const json& each : unless_removed(store.study_of(run)).value("variants", json::array()))
        variants.push_back(each.at("name"));
    if (variants.size() < 2) return json::array();
    return same_results(all_rows(), variants);
}

}  // namespace

/// For answers whose last entry is long and is written as text.
std::string opened(const json& object) {
    std::string text = object.dump(-1, ' ', false, json::error_handler_t::replace);
    text.back() = ',';
    return text;
}

/// The verdict is made again here: equal results of variants are known only from the rows.
std::string results_text(const Store& store, Run run, const std::vector<ResultRow>& rows,
                         const std::vector<ResultRow>& means, const AllRows& all_rows) {
    json without = json::array();
    for (const WithoutTransfer& each : store.without_transfer(run.id))
        without.push_back({{"variant", each.variant},
                           {"fem_task", each.fem_task},
                           {"state", each.state},
                           {"stood", each.stood},
                           {"reason", each.reason}});
    const json same = same_results_of(store, run.id, all_rows);
    run.facts.same_results = same;
    const json head{{"run", run.id},
                    {"verdict", findings::as_json(findings::verdict_of(run.facts))},
                    {"columns", described(result_columns())},
                    {"mean_columns", described(mean_columns())},
                    {"without_transfer", std::move(without)},
                    {"same_results", same}};
    return opened(head) + "\"rows\":" + as_json_text(rows, result_columns()) +
           ",\"means\":" + as_json_text(means, mean_columns()) + "}";
}

json schema_of_rows(Columns columns) {
    json properties = json::object();
    json required = json::array();
    for (const ResultColumn& each : columns) {
        json schema = schema_of(each.kind);
        schema["description"] =
            each.meaning + (*each.unit == '\0' ? "" : " [" + std::string(each.unit) + "]");
        properties[each.name] = std::move(schema);
        required.push_back(each.name);
    }
    return {{"type", "object"},
            {"properties", properties},
            {"required", required},
            {"additionalProperties", false}};
}

json as_json(const std::vector<fault::Fault>& faults) {
    json list = json::array();
    for (const fault::Fault& each : faults)
        list.push_back({{"pointer", each.pointer}, {"cause", each.cause}, {"remedy", each.remedy}});
    return list;
}

/// CR LF, as RFC 4180 asks.
std::string as_csv(const std::vector<ResultRow>& rows, Columns columns) {
    std::string text;
    for (const ResultColumn& each : columns) text.append(text.empty() ? "" : ",").append(each.name);
    text += "\r\n";
    for (const ResultRow& row : rows) {
        const char* separator = "";
        for (const json& value : row) {
            text.append(separator).append(
                exchange::csv_field(value.is_array() ? json(codes_of(value)) : value));
            separator = ",";
        }
        text += "\r\n";
    }
    return text;
}

}  // namespace breach::orchestrator
