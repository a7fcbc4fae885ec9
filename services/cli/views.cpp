#include "services/cli/views.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

bool is_one_of(const std::string& state, std::initializer_list<const char*> states) {
    return std::ranges::find(states, state) != states.end();
}

std::string state_of(const json& object) { return object.at("state").get<std::string>(); }

/// "2026-11-21T02:38:53.123Z" -> "2026-11-21 02:38:53"
std::string moment(const json& object, const char* key) {
    std::string text = cell(object, key);
    if (text.size() < 19) return text;
    text[10] = ' ';
    return text.substr(0, 19);
}

std::string tasks_of(const json& run) {
    std::string text = cell(run, "tasks_done") + " of " + cell(run, "tasks_total") + " tasks";
    if (run.value("tasks_failed", 0) > 0) text += ", " + cell(run, "tasks_failed") + " failed";
    return text;
}

std::string percent(const json& object) {
    const std::string text = bar(object.value("progress", 0.0));
    return text.substr(text.find(']') + 1);
}

/// The sum over the attempts: what the task cost, retries included.
std::string cpu_seconds(const json& task) {
    double sum = 0.0;
    for (const json& attempt : task.at("attempts"))
        if (attempt.contains("cpu_seconds") && attempt["cpu_seconds"].is_number())
            sum += attempt["cpu_seconds"].get<double>();
    return task.at("attempts").empty() ? "-" : cell(json(sum));
}

std::string as_task_table(const json& tasks) {
    std::vector<Cells> rows;
    for (const json& task : tasks) {
        rows.push_back({cell(task, "id"), cell(task, "phase"), cell(task, "transfer_time"),
                        cell(task, "state"), percent(task), cpu_seconds(task),
                        cell(task, "message") == "-" ? "" : cell(task, "message")});
    }
    return as_table({{"task", Align::left},
                     {"phase", Align::left},
                     {"t_T [s]", Align::right},
                     {"state", Align::left},
                     {"done", Align::right},
                     {"CPU [s]", Align::right},
                     {"", Align::left}},
                    rows);
}

}  // namespace

RunEnd end_of(const json& run) {
    const std::string state = state_of(run);
    if (is_one_of(state, {"succeeded", "partial"})) return RunEnd::good;
    if (is_one_of(state, {"failed", "cancelled"})) return RunEnd::bad;
    return RunEnd::not_yet;
}

bool is_final_task(const json& task) {
    return is_one_of(state_of(task), {"cached", "succeeded", "failed", "cancelled", "skipped"});
}

std::string as_run_table(const json& runs) {
    std::vector<Cells> rows;
    for (const json& run : runs) {
        rows.push_back({cell(run, "id"), cell(run, "name"), cell(run, "state"), percent(run),
                        moment(run, "created"), tasks_of(run)});
    }
    return as_table({{"run", Align::left},
                     {"name", Align::left},
                     {"state", Align::left},
                     {"done", Align::right},
                     {"created (UTC)", Align::left},
                     {"", Align::left}},
                    rows);
}

std::string as_run_page(const json& run) {
    std::string text = cell(run, "name") + "  " + cell(run, "title") + "\n";
    text += "run       " + cell(run, "id") + "\n";
    text += "state     " + cell(run, "state") + ", " + tasks_of(run) + "\n";
    text += "created   " + moment(run, "created") + "\n";
    text += "started   " + moment(run, "started") + "\n";
    text += "finished  " + moment(run, "finished") + "\n";
    if (!run.value("message", "").empty()) text += "message   " + cell(run, "message") + "\n";
    text += "\n" + as_task_table(run.at("tasks"));
    for (const json& task : run.at("tasks")) {
        if (task.contains("fault") && !task["fault"].is_null())
            text += "\n" + cell(task, "id") + "  " + fate_of_task(task);
    }
    return text.ends_with('\n') ? text : text + "\n";
}

std::string as_task_page(const json& task) {
    std::string text = name_of_task(task) + "\n";
    text += "task      " + cell(task, "id") + "\n";
    text += "state     " + fate_of_task(task) + "\n";
    text += "done      " + bar(task.value("progress", 0.0)) + "  " + cell(task, "message") + "\n";
    std::vector<Cells> attempts;
    for (const json& each : task.at("attempts")) {
        attempts.push_back({cell(each, "number"), cell(each, "state"), moment(each, "started"),
                            moment(each, "finished"), cell(each, "exit_code"),
                            cell(each, "wall_seconds"), cell(each, "cpu_seconds")});
    }
    text += "\n" + as_table({{"attempt", Align::right},
                             {"state", Align::left},
                             {"started (UTC)", Align::left},
                             {"finished (UTC)", Align::left},
                             {"exit code", Align::right},
                             {"wall [s]", Align::right},
                             {"CPU [s]", Align::right}},
                            attempts);
    if (task.at("artifacts").empty()) return text;
    std::vector<Cells> artifacts;
    for (const json& each : task.at("artifacts"))
        artifacts.push_back({cell(each, "name"), cell(each, "bytes"), cell(each, "sha256")});
    return text + "\n" +
           as_table({{"artifact", Align::left}, {"bytes", Align::right}, {"sha256", Align::left}},
                    artifacts);
}

std::string as_result_table(const json& rows) {
    struct Quantity {
        const char* key;
        const char* title;
    };
    constexpr std::array quantities{
        Quantity{"runout", "runout [m]"},
        Quantity{"runout_beyond_toe", "beyond toe [m]"},
        Quantity{"runout_largest", "largest [m]"},
        Quantity{"volume_ratio", "volume ratio"},
        Quantity{"numerical_share", "numerical share"},
        Quantity{"cpu_seconds", "CPU [s]"},
    };
    std::vector<Column> columns{{"t_T [s]", Align::right}, {"state", Align::left}};
    for (const Quantity& each : quantities) columns.push_back({each.title, Align::right});
    columns.push_back({"", Align::left});
    std::vector<Cells> lines;
    for (const json& row : rows) {
        Cells line{cell(row, "transfer_time"), cell(row, "state")};
        for (const Quantity& each : quantities) line.push_back(cell(row, each.key));
        line.push_back(row.contains("reason") ? cell(row, "reason") : "");
        lines.push_back(std::move(line));
    }
    return as_table(columns, lines);
}

std::string as_telemetry_table(const json& lines) {
    if (lines.empty()) return "";
    std::vector<Column> columns;
    for (const auto& [key, value] : lines.front().items())
        if (value.is_primitive()) columns.push_back({key, Align::right});
    std::vector<Cells> rows;
    for (const json& line : lines) {
        Cells row;
        for (const Column& column : columns) row.push_back(cell(line, column.title.c_str()));
        rows.push_back(std::move(row));
    }
    return as_table(columns, rows);
}

std::string as_progress_line(const json& run) {
    std::string text =
        bar(run.value("progress", 0.0)) + "  " + cell(run, "state") + "  " + tasks_of(run);
    if (const json left = run.value("seconds_left", json()); left.is_number()) {
        const auto minutes = static_cast<long>(std::ceil(left.get<double>() / 60.0));
        text += "  about " + std::to_string(minutes) + " min left";
    }
    if (!run.value("message", "").empty()) text += "  " + cell(run, "message");
    return text;
}

std::string name_of_task(const json& task) {
    std::string text = cell(task, "phase");
    if (cell(task, "transfer_time") != "-") text += "  t_T " + cell(task, "transfer_time") + " s";
    return text;
}

std::string fate_of_task(const json& task) {
    std::string text = cell(task, "state");
    if (!task.contains("fault") || task["fault"].is_null()) return text;
    const std::string code = cell(task["fault"], "exit_code");
    if (code != "-") text += " (exit code " + code + ")";
    return text + ": " + cell(task["fault"], "summary");
}

}  // namespace breach::cli
