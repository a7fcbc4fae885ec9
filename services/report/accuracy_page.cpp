#include "services/report/accuracy_page.hpp"

#include <algorithm>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr const char* head =
    "# Error against run time\n"
    "\n"
    "Written by `report accuracy`. CPU seconds are of one run through all its phases.\n"
    "\n"
    "*Error* is that of the mean over the repeats (on moved lattices of points, or of the "
    "FEM with other steps and residuals). *Of a run* is the error of one run: with the error of "
    "the reference, that of the base on the other ladders, and the scatter. "
    "*Order*, *limit* and *grid convergence index* are given only where three rungs converge "
    "monotonically and by more than the noise. `*`: on the "
    "Pareto front; `~`: within the noise; `?`: a run is questionable, so the setting "
    "is not recommended. *Repeats for* an error: repeats whose mean "
    "is within it nine times in ten (Student's interval for the mean of new repeats, and the "
    "bias); "
    "`-`: more than 20.\n";

std::string number(const json& value, int digits = 4) {
    return value.is_number() ? rounded(value.get<double>(), digits) : "-";
}

std::string percent(const json& share) {
    if (!share.is_number()) return "-";
    const double value = 100.0 * share.get<double>();
    return rounded(value, value < 99.5 ? 2 : 4) + " %";
}

std::string setting_of(const json& row) {
    std::string text;
    for (const json& each : row.at("setting"))
        text += (text.empty() ? "`" : " `") + each.get<std::string>() + "`";
    return text;
}

bool has_place(const json& row) {
    return row.at("error_of_a_run").is_number() && row.at("error_of_a_run") > 0.0 &&
           row.at("cpu_seconds").is_number() && row.at("cpu_seconds") > 0.0;
}

void add_row(const json& row, Series& series) {
    series.x.push_back(row.at("cpu_seconds"));
    series.y.push_back(100.0 * row.at("error_of_a_run").get<double>());
}

Series front_of(const json& rows) {
    Series front{"Pareto front", {}, {}, Style::line};
    std::vector<const json*> on_front;
    for (const json& row : rows)
        if (row.at("on_pareto_front") == true && has_place(row)) on_front.push_back(&row);
    std::ranges::sort(on_front, {},
                      [](const json* row) { return row->at("cpu_seconds").get<double>(); });
    for (const json* row : on_front) add_row(*row, front);
    return front;
}

std::string quantity_of(const json& table) {
    std::string text = table.at("quantity");
    if (table.at("time").is_number()) text += " at " + number(table.at("time")) + " s";
    if (table.at("transfer_time").is_number())
        text += ", transfer at " + number(table.at("transfer_time")) + " s";
    return text;
}

std::string marks_of(const json& row) {
    std::string marks;
    if (row.at("on_pareto_front") == true) marks += "*";
    if (row.at("below_noise") == true) marks += "~";
    if (row.at("questionable") == true) marks += "?";
    const std::string reason = row.at("reason");
    if (!marks.empty()) marks = "`" + marks + "`";
    return marks + (marks.empty() || reason.empty() ? "" : " ") + reason;
}

/// From the mean within the requested error; "-": none.
std::string of_mean(const json& row, const char* key) {
    const json& mean = row.at("mean_within_asked");
    return mean.is_object() ? number(mean.at(key), 3) : "-";
}

std::string table_of(const json& table) {
    std::string unit = table.at("unit");
    if (unit == "1") unit = "-";
    std::string text = "| ladder | setting | " + table.at("quantity").get<std::string>() + " [" +
                       unit +
                       "] | +- | repeats | error | of a run | CPU s | wall s | MB | repeats for " +
                       percent(table.at("asked_error")) +
                       " | their CPU s | |\n"
                       "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const json& row : table.at("rows")) {
        for (const std::string& cell :
             {row.at("ladder").get<std::string>(), setting_of(row), number(row.at("value")),
              number(row.at("standard_deviation"), 2), number(row.at("draws")),
              percent(row.at("error")), percent(row.at("error_of_a_run")),
              number(row.at("cpu_seconds"), 3), number(row.at("wall_seconds"), 3),
              number(row.at("peak_memory_MB"), 3), of_mean(row, "draws"),
              of_mean(row, "cpu_seconds"), marks_of(row)})
            text += "| " + cell + " ";
        text += "|\n";
    }
    return text;
}

std::string section_of(const AccuracyAnswer& answer, const std::string& figures) {
    const json& table = answer.table;
    std::string text = "\n## " + answer.name + "\n\n" + quantity_of(table) +
                       "; errors relative to " + table.at("reference").get<std::string>() + ".";
    if (!table.at("base").empty()) {
        text += " All rungs:";
        for (const json& each : table.at("base")) text += " `" + each.get<std::string>() + "`";
        text += ".";
    }
    text += "\n\n" + table_of(table) + "\n";
    for (const json& ladder : table.at("ladders"))
        text += "- " + ladder.at("name").get<std::string>() + ": " +
                ladder.at("message").get<std::string>() + "\n";
    text += "\n**" + table.at("recommendation").get<std::string>() + "**\n";
    if (!error_against_time(answer).chart.series.empty())
        text += "\n![error against CPU seconds](" + figures + "/" + answer.name + ".svg)\n";
    return text;
}

AccuracyAnswer answer_in(const std::filesystem::path& file) {
    AccuracyAnswer answer{file.stem().string(), read_json(file)};
    if (!answer.table.is_object() || !answer.table.contains("recommendation"))
        throw fault::BadInput(file.string(), {{"", "is no table of an accuracy study",
                                               "write it with breach accuracy --of RUN --json"}});
    return answer;
}

}  // namespace

Figure error_against_time(const AccuracyAnswer& answer) {
    const json& table = answer.table;
    Figure figure{answer.name,
                  {answer.name + ": " + quantity_of(table),
                   {"CPU seconds of one run", Scale::logarithmic},
                   {"error of one run [%]", Scale::logarithmic},
                   {}}};
    for (const json& ladder : table.at("ladders")) {
        Series series{ladder.at("name"), {}, {}, Style::line_and_points};
        for (const json& row : table.at("rows"))
            if (row.at("ladder") == ladder.at("name") && has_place(row)) {
                add_row(row, series);
                series.certainty.push_back(row.at("questionable") == true ? Certainty::doubtful
                                                                          : Certainty::certain);
            }
        if (!series.x.empty()) figure.chart.series.push_back(std::move(series));
    }
    if (figure.chart.series.empty()) return figure;
    if (Series front = front_of(table.at("rows")); front.x.size() > 1)
        figure.chart.series.push_back(std::move(front));
    const double asked = 100.0 * table.at("asked_error").get<double>();
    figure.chart.marks.push_back({Mark::At::y, asked, "asked: " + rounded(asked, 3) + " %"});
    return figure;
}

std::string accuracy_page(const std::vector<AccuracyAnswer>& answers, const std::string& figures) {
    std::string page = head;
    for (const AccuracyAnswer& each : answers) page += section_of(each, figures);
    return page;
}

void write_accuracy_page(const std::vector<std::filesystem::path>& files,
                         const std::filesystem::path& page) {
    std::vector<AccuracyAnswer> answers;
    for (const auto& each : files) answers.push_back(answer_in(each));
    const std::string folder = page.stem().string();
    try {
        std::vector<Figure> figures;
        for (const AccuracyAnswer& each : answers)
            if (Figure figure = error_against_time(each); !figure.chart.series.empty())
                figures.push_back(std::move(figure));
        write_figures(page.parent_path() / folder, figures);
        exchange::publish_text(page, accuracy_page(answers, folder));
    } catch (const json::exception& error) {
        throw fault::BadInput(page.string(),
                              {{"", error.what(), "write the tables anew with this version"}});
    }
}

}  // namespace breach::report
