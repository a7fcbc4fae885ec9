// The picture of the first page: the section before and after.
#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/stability_figures.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

namespace {

/// Columns 0 and 3 of profile.csv, x and the surface [m]; without points: no such file.
Series surface_of(const PhaseFolder& mpm) {
    Series s{"after, " + of_transfer(mpm) + (still_moves(mpm) ? " (still moving)" : ""), {}, {}};
    std::ifstream table(mpm.files / "profile.csv");
    std::string line;
    std::getline(table, line);  // headings
    while (std::getline(table, line)) {
        std::istringstream cells(line);
        std::vector<double> values;
        for (std::string cell; std::getline(cells, cell, ',');) {
            double value = 0.0;
            std::from_chars(cell.data(), cell.data() + cell.size(), value);
            values.push_back(value);
        }
        if (values.size() < 4) return s;
        s.x.push_back(values[0]);
        s.y.push_back(values[3]);
    }
    return s;
}

/// From the first phase that has one; without points: none.
Series phreatic_line(const json& scene) {
    for (const char* each : {"/fem/water/line", "/lem/water/line", "/transfer/phreatic_line"})
        if (const json line = scene.value(json::json_pointer(each), json()); line.is_array())
            return line_of(line, "phreatic line");
    return {};
}

}  // namespace

Figure overview_of(const Run& run) {
    const PhaseFolder* farthest = farthest_runout(run);
    const PhaseFolder* least = least_factor(run);
    const json& scene = farthest ? farthest->scene : least ? least->scene : run.scene;
    Chart chart{"The section before and after", {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
    chart.series.push_back(section_at_rest(scene));
    chart.series.back().name = "before";
    if (farthest) chart.series.push_back(surface_of(*farthest));
    chart.series.push_back(phreatic_line(scene));
    if (least)
        if (auto surface = critical_surface(least->scene, least->result))
            chart.series.push_back(std::move(*surface));
    std::erase_if(chart.series, [](const Series& each) { return each.x.empty(); });
    const json toe = scene.value("/mpm/runout/toe"_json_pointer, json());
    if (farthest && toe.is_array()) {
        const double x = toe.at(0);
        chart.marks = {{Mark::At::x, x, "toe"},
                       {Mark::At::x, x + runout_of(farthest),
                        "runout " + bounded(*farthest, rounded(runout_of(farthest), 3)) + " m"}};
    } else {
        chart.title = "The section";
    }
    return {"overview", std::move(chart)};
}

}  // namespace breach::report
