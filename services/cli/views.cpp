// Lists and pages of runs, tasks and results as text. It gets the server's answers and asks for
// nothing itself.
#include "services/cli/views.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

bool is_one_of(const std::string& state, std::initializer_list<const char*> states) {
    return std::ranges::find(states, state) != states.end();
}

std::string state_of(const json& object) { return object.at("state").get<std::string>(); }

/// "2026-11-21T02:38:53.123Z" -> "2026-11-21 02:38:53"
/// Without fractions of a second and the Z: all times of the server are UTC.
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

/// bar() knows how to round; the picture is cut off.
std::string percent(const json& object) {
    const std::string text = bar(object.value("progress", 0.0));
    return text.substr(text.find(']') + 1);
}

/// CPU seconds of all attempts, including retries.
std::string cpu_seconds(const json& task) {
    double sum = 0.0;
    for (const json& attempt : task.at("attempts"))
        if (attempt.contains("cpu_seconds") && attempt["cpu_seconds"].is_number())
            sum += attempt["cpu_seconds"].get<double>();
    return task.at("attempts").empty() ? "-" : cell(json(sum));
}

bool is_yes(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// Of a task or a row; empty: unknown.
json flags_of(const json& object) {
    const auto found = object.find("flags");
    return found != object.end() && found->is_array() ? *found : json::array();
}

std::string codes_of(const json& flags) {
    std::string codes;
    for (const json& each : flags) {
        const std::string code = cell(each, "code");
        if (codes.find(code) == std::string::npos) codes += (codes.empty() ? "" : ", ") + code;
    }
    return codes;
}

/// "ended: entangled at 6.7 s": a regular end other than the planned one.
std::string unusual_end(const json& task) {
    if (cell(task, "ended") != "entangled") return "";
    return "ended: entangled at " + cell(task, "end_time") + " s";
}

/// What a list has room for: an unusual end and the codes of flags; the page of the task has their
/// messages.
std::string note_of(const json& task) {
    std::string note = unusual_end(task);
    if (const std::string codes = codes_of(flags_of(task)); !codes.empty())
        note += (note.empty() ? "" : ", ") + codes;
    if (note.empty() && cell(task, "message") != "-") note = cell(task, "message");
    return note;
}

/// What a reader must know about a success comes before it.
std::string state_shown(const json& task) {
    if (is_yes(task, "not_reached")) return "not_reached";
    return is_yes(task, "questionable") ? "questionable" : cell(task, "state");
}

/// Explains each flag once: which results have it, and the message of the first.
class Legend {
  public:
    /// `where`: the result with the flag, in words
    void add(const json& flag, const std::string& where) {
        const std::string code = cell(flag, "code");
        const std::string severity = cell(flag, "severity");
        const auto same = std::ranges::find_if(
            entries_, [&](const Entry& e) { return e.code == code && e.severity == severity; });
        const std::string message = cell(flag, "message");
        if (same == entries_.end()) {
            entries_.push_back({code, severity, message, where, {where}, false});
        } else {
            same->places.insert(where);
            same->differs |= same->message != message;
        }
    }

    /// "a" for the first flag that was added.
    std::string mark_of(const json& flag) const {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (entries_[i].code != cell(flag, "code") ||
                entries_[i].severity != cell(flag, "severity"))
                continue;
            return i < 26 ? std::string(1, static_cast<char>('a' + i)) : entries_[i].code;
        }
        return "";
    }

    std::string as_text(const std::string& of_what) const {
        std::string text;
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            const Entry& each = entries_[i];
            text += std::string(1, i < 26 ? static_cast<char>('a' + i) : ' ') + "  " + each.code +
                    " (" + each.severity + "), " + std::to_string(each.places.size()) + of_what +
                    "\n   " + (each.differs ? each.first + ": " : "") + each.message + "\n";
        }
        return text;
    }

  private:
    struct Entry {
        std::string code;
        std::string severity;
        std::string message;
        std::string first;
        std::set<std::string> places;
        bool differs;  ///< results have different messages
    };
    std::vector<Entry> entries_;
};

std::string as_task_table(const json& tasks) {
    std::vector<Cells> rows;
    for (const json& task : tasks) {
        rows.push_back({cell(task, "id"), cell(task, "phase"), whole_cell(task, "transfer_time"),
                        state_shown(task), percent(task), cpu_seconds(task), note_of(task)});
    }
    return as_table({{"task"},
                     {"phase"},
                     {"t_T [s]", right},
                     {"state"},
                     {"done", right},
                     {"CPU [s]", right},
                     {""}},
                    rows);
}

}  // namespace

RunEnd end_of(const json& run) {
    const std::string state = state_of(run);
    if (is_one_of(state, {"succeeded", "questionable", "partial"})) return RunEnd::good;
    if (is_one_of(state, {"failed", "cancelled"})) return RunEnd::bad;
    return RunEnd::not_yet;
}

bool is_doubtful(const json& run) {
    return is_one_of(cell(run.value("verdict", json::object()), "usable"), {"questionable", "no"});
}

std::string warning_of(const json& run) {
    return is_doubtful(run) ? cell(run.at("verdict"), "words") + ": " + cell(run, "message") : "";
}

bool is_final_task(const json& task) {
    return is_one_of(state_of(task), {"cached", "succeeded", "failed", "cancelled", "skipped"});
}

static std::string note_of_run(const json& run) {
    std::string note = tasks_of(run);
    if (run.at("headline").at("text") != "") note += "  " + cell(run.at("headline"), "text");
    return is_doubtful(run) ? note + "  " + warning_of(run) : note;
}

std::string as_run_table(const json& runs) {
    std::vector<Cells> rows;
    for (const json& run : runs) {
        rows.push_back({cell(run, "id"), cell(run, "name"), cell(run, "state"), percent(run),
                        moment(run, "created"), note_of_run(run)});
    }
    return as_table({{"run"}, {"name"}, {"state"}, {"done", right}, {"created (UTC)"}, {""}}, rows);
}

std::string as_verdict(const json& headline, const json& verdict, const json& results) {
    std::vector<json> explained;
    for (const json& each : results)
        for (const json& flag : flags_of(each)) explained.push_back(flag);
    const auto is_explained = [&](const json& reason) {
        return std::ranges::any_of(explained, [&](const json& flag) {
            return flag.at("code") == reason.at("code") &&
                   cell(reason, "text").find(cell(flag, "message")) != std::string::npos;
        });
    };
    std::string text;
    if (headline.at("text") != "") text += "Result: " + cell(headline, "text") + "\n";
    text += "Verdict: " + cell(verdict, "words") + "\n";
    for (const json& each : verdict.at("reasons"))
        if (!is_explained(each)) text += "  " + cell(each, "text") + "\n";
    return text + "\n";
}

std::string as_run_page(const json& run) {
    std::string text = cell(run, "name") + "  " + cell(run, "title") + "\n";
    text += "run       " + cell(run, "id") + "\n";
    text += "state     " + cell(run, "state") + ", " + tasks_of(run) + "\n";
    const std::string by = cell(run, "submitted_by");
    text += "created   " + moment(run, "created") + (by == "-" ? "" : " by " + by) + "\n";
    text += "started   " + moment(run, "started") + "\n";
    text += "finished  " + moment(run, "finished") + "\n";
    if (!run.value("message", "").empty()) text += "message   " + cell(run, "message") + "\n";
    text += "\n" + as_verdict(run.at("headline"), run.at("verdict"), run.at("tasks")) +
            as_task_table(run.at("tasks"));
    for (const json& task : run.at("tasks")) {
        if (task.contains("fault") && !task["fault"].is_null())
            text += "\n" + cell(task, "id") + "  " + end_of_task(task);
    }
    if (!text.ends_with('\n')) text += "\n";
    Legend legend;
    for (const json& task : run.at("tasks"))
        for (const json& flag : flags_of(task)) legend.add(flag, name_of_task(task));
    const std::string flags = legend.as_text(" results");
    return flags.empty() ? text : text + "\n" + flags;
}

std::string as_task_page(const json& task) {
    std::string text = name_of_task(task) + "\n";
    text += "task      " + cell(task, "id") + "\n";
    text += "state     " + end_of_task(task) + "\n";
    text += "done      " + bar(task.value("progress", 0.0)) + "  " + cell(task, "message") + "\n";
    std::vector<Cells> attempts;
    for (const json& each : task.at("attempts")) {
        attempts.push_back({cell(each, "number"), cell(each, "state"), moment(each, "started"),
                            moment(each, "finished"), cell(each, "exit_code"),
                            cell(each, "wall_seconds"), cell(each, "cpu_seconds")});
    }
    text += "\n" + as_table({{"attempt", right},
                             {"state"},
                             {"started (UTC)"},
                             {"finished (UTC)"},
                             {"exit code", right},
                             {"wall [s]", right},
                             {"CPU [s]", right}},
                            attempts);
    for (const json& each : flags_of(task))
        text += "\n" + cell(each, "code") + " (" + cell(each, "severity") + ")\n   " +
                cell(each, "message") + "\n";
    if (task.at("artifacts").empty()) return text;
    std::vector<Cells> artifacts;
    for (const json& each : task.at("artifacts"))
        artifacts.push_back({cell(each, "name"), cell(each, "bytes"), cell(each, "sha256")});
    return text + "\n" + as_table({{"artifact"}, {"bytes", right}, {"sha256"}}, artifacts);
}

namespace {

/// Without columns that are empty in all rows, once a row has a result: a static scene has no
/// transfer time, a stability analysis no runout.
std::vector<json> without_empty(std::vector<json> columns, const json& rows) {
    const auto is_empty = [&](const std::string& name) {
        return std::ranges::all_of(
            rows, [&](const json& row) { return row.value(name, json()).is_null(); });
    };
    if (!is_empty("cpu_seconds"))
        std::erase_if(columns, [&](const json& each) { return is_empty(each.at("name")); });
    return columns;
}

/// The columns that people read first, then the others in the server's order.
std::vector<json> columns_for_people(const json& columns, const json& rows) {
    const bool variants =
        std::ranges::any_of(rows, [](const json& row) { return row.value("variant", "") != ""; });
    std::vector<json> found;
    for (const char* name : {"variant", "transfer_time", "state", "at_rest"})
        for (const json& each : columns)
            if (each.at("name") == name && (variants || each["name"] != "variant"))
                found.push_back(each);
    for (const json& each : columns)
        if (each.at("title") != "" && each.at("name") != "variant" &&
            std::ranges::find(found, each) == found.end())
            found.push_back(each);
    return without_empty(std::move(found), rows);
}

std::string heading_of(const json& column) {
    const std::string unit = column.at("unit");
    return cell(column, "title") + (unit.empty() || unit == "1" ? "" : " [" + unit + "]");
}

std::string result_cell(const json& row, const json& column) {
    const std::string name = column.at("name");
    if (name == "transfer_time") return whole_cell(row, "transfer_time");
    const json value = row.value(name, json());
    const bool bound = column.value("grows", false) && row.value("lower_bound", json()) == true;
    if (!value.is_boolean()) return (bound && !value.is_null() ? "\u2265 " : "") + cell(value);
    if (name == "at_rest") return value.get<bool>() ? "yes" : "MOVING";
    return value.get<bool>() ? "yes" : "no";
}

std::string place_of(const json& row) {
    const std::string variant = harmless(row.value("variant", ""));
    if (row.value("transfer_time", json()).is_null()) return variant.empty() ? "the run" : variant;
    return (variant.empty() ? "" : variant + ", ") + "t_T " + whole_cell(row, "transfer_time") +
           " s";
}

}  // namespace

std::string as_result_table(const json& answer) {
    const json& rows = answer.at("rows");
    const std::vector<json> shown = columns_for_people(answer.at("columns"), rows);
    std::vector<Column> columns;
    for (const json& each : shown)
        columns.push_back(
            {heading_of(each), each.at("kind") == "number" ? Align::right : Align::left});
    columns.push_back({""});
    Legend legend;
    for (const char* severity : {"questionable", "warning"})
        for (const json& row : rows)
            for (const json& flag : flags_of(row))
                if (cell(flag, "severity") == severity) legend.add(flag, place_of(row));
    std::vector<Cells> lines;
    for (const json& row : rows) {
        Cells line;
        for (const json& each : shown) line.push_back(result_cell(row, each));
        std::set<std::string> marks;
        for (const json& flag : flags_of(row)) marks.insert(legend.mark_of(flag));
        std::string last;
        for (const std::string& each : marks) last += (last.empty() ? "" : " ") + each;
        if (!row.value("reason", "").empty())
            last += (last.empty() ? "" : "  ") + cell(row, "reason");
        line.push_back(last);
        lines.push_back(std::move(line));
    }
    const std::string notes = legend.as_text(" of " + std::to_string(rows.size()) + " rows");
    return as_table(columns, lines) + (notes.empty() ? "" : "\n" + notes);
}

std::string as_mean_table(const json& answer) {
    const json means = answer.value("means", json::array());
    if (means.empty()) return "";
    const bool variants =
        std::ranges::any_of(means, [](const json& row) { return row.value("variant", "") != ""; });
    std::vector<Column> columns;
    if (variants) columns.push_back({"variant"});
    for (const char* each : {"t_T [s]", "state", "repeats"}) columns.push_back({each, Align::left});
    for (const char* each : {"mean runout [m]", "+-", "beyond toe [m]", "+-", "largest [m]", "+-"})
        columns.push_back({each, Align::right});
    columns.push_back({"mean is off by [m]", right});
    columns.push_back({""});
    std::vector<Cells> lines;
    for (const json& row : means) {
        Cells line;
        if (variants) line.push_back(cell(row, "variant"));
        line.push_back(whole_cell(row, "transfer_time"));
        line.push_back(cell(row, "state"));
        line.push_back(cell(row, "draws_done") + " of " + cell(row, "draws"));
        for (const char* each : {"runout", "runout_beyond_toe", "runout_largest"}) {
            const bool bound = row.value("lower_bound", json()) == true;
            line.push_back((bound ? "\u2265 " : "") + cell(row, each));
            line.push_back(cell(row, (each + std::string("_deviation")).c_str()));
        }
        line.push_back(cell(row, "runout_error"));
        std::string note;
        for (const char* each : {"missing", "questionable"}) {
            const std::string key = each + std::string("_draws");
            if (!row.value(key, "").empty())
                note += (note.empty() ? "" : "; ") + (each + std::string(" repeats: ")) +
                        cell(row, key.c_str());
        }
        line.push_back(note);
        lines.push_back(std::move(line));
    }
    return as_table(columns, lines) +
           "+-: standard deviation of one repeat; off by: nine of ten such means\n";
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
    if (end_of(run) == RunEnd::good && run.at("headline").at("text") != "")
        text += "  " + cell(run.at("headline"), "text");
    if (!run.value("message", "").empty()) text += "  " + cell(run, "message");
    return text;
}

std::string name_of_task(const json& task) {
    std::string text = cell(task, "phase");
    if (whole_cell(task, "transfer_time") != "-")
        text += "  t_T " + whole_cell(task, "transfer_time") + " s";
    return text;
}

std::string end_of_task(const json& task) {
    std::string text = state_shown(task);
    if (text == "questionable") text += " (" + codes_of(flags_of(task)) + ")";
    if (const std::string end = unusual_end(task); !end.empty()) text += ", " + end;
    if (!task.contains("fault") || task["fault"].is_null()) return text;
    const std::string code = cell(task["fault"], "exit_code");
    if (code != "-") text += " (exit code " + code + ")";
    return text + ": " + cell(task["fault"], "summary");
}

}  // namespace breach::cli
