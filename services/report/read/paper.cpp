#include "services/report/read/paper.hpp"

#include <nlohmann/json.hpp>

namespace breach::report {

using nlohmann::json;

std::optional<Paper> paper_for(const std::string& scene_name) {
    const json text = json::parse(paper_text());
    if (!scene_name.starts_with(text.at("scenes_begin_with").get<std::string>())) return {};
    Paper paper{
        text.at("source"), text.at("remarks"), {}, {}, {}, text.at("case_history_runout_m")};
    for (const json& each : text.at("values")) {
        PaperValue value{each.at("key"), each.at("what"), each.at("unit"), each.at("value"),
                         each.value("first_time", "")};
        if (each.contains("runout_at_s")) value.runout_at = each.at("runout_at_s").get<double>();
        paper.values.push_back(std::move(value));
    }
    for (const json& each : text.at("points")) {
        paper.points.push_back(
            {each.at("figure"), {each.at("series"), each.at("x"), each.at("y"), Style::points}});
    }
    for (const json& each : text.at("notes")) {
        paper.notes.push_back(
            {each.at("table"), each.at("text"), each.at("entry"), each.at("value")});
    }
    return paper;
}

void add_points(const std::optional<Paper>& paper, Figure& figure) {
    if (!paper) return;
    for (const PaperPoints& each : paper->points) {
        if (each.figure == figure.name) figure.chart.series.push_back(each.series);
    }
}

}  // namespace breach::report
