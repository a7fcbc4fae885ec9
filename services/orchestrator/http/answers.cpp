#include "services/orchestrator/http/answers.hpp"

#include <algorithm>
#include <array>
#include <ctime>

namespace breach::orchestrator {

using nlohmann::json;

namespace {

template <class T>
json or_null(const std::optional<T>& value) {
    return value ? json(*value) : json(nullptr);
}

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

/// As if the rest went like what has been done since the start; null until that says something.
json seconds_left(const Run& run, double progress) {
    constexpr double too_early = 0.02;
    if (run.finished || !run.started || run.paused || progress < too_early) return nullptr;
    std::tm begin{};
    if (strptime(run.started->c_str(), "%Y-%m-%dT%H:%M:%S", &begin) == nullptr) return nullptr;
    const double elapsed = std::difftime(std::time(nullptr), timegm(&begin));
    return std::max(0.0, elapsed) * (1.0 - progress) / progress;
}

constexpr std::array columns{
    "transfer_time",  "state",        "runout",          "runout_beyond_toe",
    "runout_largest", "volume_ratio", "numerical_share", "overlap",
    "cpu_seconds",    "reason",       "transfer_task",   "mpm_task",
    "variant",        "reused",       "trigger"};

std::string csv_field(const json& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.dump();
    std::string quoted = "\"";
    for (const char each : value.get_ref<const std::string&>()) {
        if (each == '"') quoted += '"';
        quoted += each;
    }
    return quoted + '"';
}

}  // namespace

json as_json(const Run& run, const ProgressBoard& board) {
    double progress = 1.0;
    if (!run.finished && run.tasks_total > 0) {
        progress = (static_cast<double>(run.tasks_ended) + board.sum_of_run(run.id)) /
                   static_cast<double>(run.tasks_total);
    }
    return {{"id", run.id},
            {"name", run.name},
            {"title", run.title},
            {"state", run.state},
            {"created", run.created},
            {"started", or_null(run.started)},
            {"finished", or_null(run.finished)},
            {"progress", progress},
            {"tasks_total", run.tasks_total},
            {"tasks_done", run.tasks_done},
            {"tasks_failed", run.tasks_failed},
            {"paused", run.paused},
            {"seconds_left", seconds_left(run, progress)},
            {"message", run.message}};
}

json as_json(const Task& task, const std::vector<Attempt>& attempts,
             const std::vector<Artifact>& artifacts, const ProgressBoard& board) {
    Progress progress = board.of(task.id);
    if (is_final(task.state)) progress.fraction = 1.0;
    json tried = json::array();
    for (const Attempt& each : attempts) tried.push_back(as_json(each));
    json kept = json::array();
    for (const Artifact& each : artifacts)
        kept.push_back({{"name", each.name}, {"sha256", each.sha256}, {"bytes", each.bytes}});
    json fault = nullptr;
    if (task.fault)
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

json as_json(const SweepRow& row) {
    return {{"transfer_time", row.transfer_time},
            {"state", row.state},
            {"runout", or_null(row.runout)},
            {"runout_beyond_toe", or_null(row.runout_beyond_toe)},
            {"runout_largest", or_null(row.runout_largest)},
            {"volume_ratio", or_null(row.volume_ratio)},
            {"numerical_share", or_null(row.numerical_share)},
            {"overlap", or_null(row.overlap)},
            {"cpu_seconds", or_null(row.cpu_seconds)},
            {"reason", row.reason},
            {"transfer_task", row.transfer_task},
            {"mpm_task", row.mpm_task},
            {"variant", row.variant},
            {"reused", row.reused},
            {"trigger", row.trigger}};
}

json as_json(const std::vector<fault::Fault>& faults) {
    json list = json::array();
    for (const fault::Fault& each : faults)
        list.push_back({{"pointer", each.pointer}, {"cause", each.cause}, {"remedy", each.remedy}});
    return list;
}

std::string as_csv(const std::vector<SweepRow>& rows) {
    std::string text;
    for (const char* name : columns) text.append(text.empty() ? "" : ",").append(name);
    text += "\r\n";
    for (const SweepRow& row : rows) {
        const json fields = as_json(row);
        const char* separator = "";
        for (const char* name : columns) {
            text.append(separator).append(csv_field(fields.at(name)));
            separator = ",";
        }
        text += "\r\n";
    }
    return text;
}

}  // namespace breach::orchestrator
