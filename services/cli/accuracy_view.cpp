// Table of an accuracy study for `breach accuracy`. It only formats: what is recommended, on the
// front or below the noise was decided by the server, so that the page and the report agree.
#include "services/cli/accuracy_view.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "services/cli/table.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

/// "3.2 %"; "-" for null.
/// Two digits, as an error is an estimate itself. From 99.5 on, %.2g would print 1e+02.
std::string percent_of(const json& share) {
    if (!share.is_number()) return "-";
    char text[32];
    const double value = 100.0 * share.get<double>();
    std::snprintf(text, sizeof text, value < 99.5 ? "%.2g %%" : "%.0f %%", value);
    return text;
}

/// A ladder may change several entries at once.
std::string setting_of(const json& row) {
    std::string words;
    for (const json& each : row.at("setting")) words += (words.empty() ? "" : "  ") + cell(each);
    return words;
}

/// Rows have no id of their own: a ladder and its step identify one.
bool is_recommended(const json& row, const json& answer) {
    const json& best = answer.at("recommended");
    return best.is_object() && best.at("ladder") == row.at("ladder") &&
           best.at("step") == row.at("step");
}

/// Note of a row: "=>" recommended, "*" on the front, "~" below noise, "?" questionable; reasons.
std::string note_of(const json& row, const json& answer) {
    std::string note = is_recommended(row, answer) ? "=>" : "";
    const auto add = [&](const std::string& words) { note += (note.empty() ? "" : " ") + words; };
    if (row.at("on_pareto_front").get<bool>()) add("*");
    if (row.at("below_noise").get<bool>()) add("~");
    if (row.at("questionable").get<bool>()) add("?");
    if (!row.at("reason").get<std::string>().empty()) add(" " + cell(row, "reason"));
    return note;
}

/// From the mean within the requested error; "-": none.
/// The server gives no mean where more than 20 repeats would be needed.
std::string of_mean(const json& row, const char* key) {
    const json& mean = row.at("mean_within_asked");
    return mean.is_object() ? cell(mean, key) : "-";
}

/// The unit "1" marks quantities without one.
std::string title_of(const json& answer) {
    std::string title = cell(answer, "quantity");
    if (answer.at("time").is_number()) title += " at " + cell(answer, "time") + " s";
    if (answer.at("unit") != "1") title += " [" + cell(answer, "unit") + "]";
    return title;
}

/// Only the marks that occur.
std::string legend_of(const json& answer) {
    std::string legend;
    const auto any = [&](const char* key) {
        for (const json& row : answer.at("rows"))
            if (row.at(key).get<bool>()) return true;
        return false;
    };
    if (any("on_pareto_front")) legend += "*  nothing else is as cheap and as accurate\n";
    if (any("below_noise")) legend += "~  the error is within the noise\n";
    if (any("questionable"))
        legend += "?  questionable (`breach results` says why): not recommended\n";
    return legend;
}

}  // namespace

std::string as_accuracy_table(const json& answer) {
    std::vector<Cells> rows;
    for (const json& row : answer.at("rows")) {
        rows.push_back({cell(row, "ladder"), setting_of(row), cell(row, "value"),
                        cell(row, "standard_deviation"), cell(row, "draws"),
                        percent_of(row.at("error")), percent_of(row.at("error_of_a_run")),
                        cell(row, "cpu_seconds"), cell(row, "wall_seconds"),
                        cell(row, "peak_memory_MB"), of_mean(row, "draws"),
                        of_mean(row, "cpu_seconds"), note_of(row, answer)});
    }
    std::string text =
        as_table({{"ladder"},
                  {"setting"},
                  {title_of(answer), Align::right},
                  {"+-", right},
                  {"repeats", right},
                  {"error", right},
                  {"of a run", right},
                  {"CPU [s]", right},
                  {"wall [s]", right},
                  {"memory [MB]", right},
                  {"repeats for " + percent_of(answer.at("asked_error")), Align::right},
                  {"their CPU [s]", right},
                  {""}},
                 rows);
    text += "errors relative to " + cell(answer, "reference") +
            "; \"of a run\": including the error of the reference, of the other ladders at the "
            "base, and the scatter; \"repeats for\": repeats whose mean is within that error nine "
            "times in ten, -: more than 20\n" +
            legend_of(answer) + "\n";
    for (const json& ladder : answer.at("ladders"))
        text += cell(ladder, "name") + ": " + cell(ladder, "message") + "\n";
    return text + "\n" + cell(answer, "recommendation") + "\n";
}

}  // namespace breach::cli
