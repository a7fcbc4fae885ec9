#include "services/report/figures/stability_figures.hpp"

#include <cmath>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

Figure safety_against_depth(const json& result) {
    Series F{"Bishop", {}, {}, Style::line_and_points};
    for (const json& stage : result.at("stages")) {
        F.x.push_back(stage.at("liquefied_depth"));
        F.y.push_back(stage.at("factor_of_safety"));
    }
    Chart chart{"Factor of safety against liquefied depth",
                {"liquefied depth [m]"},
                {"factor of safety [-]"},
                {F},
                {{Mark::At::y, 1.0, "FS = 1"}}};
    const double critical = result.at("critical_depth");
    chart.marks.push_back({Mark::At::x, critical, "critical " + rounded(critical, 3) + " m"});
    return {"safety_against_depth", chart};
}

/// The lower arc between its ends, 60 chords. Composite surfaces are not cut at their floor.
Series arc(const json& facts, const std::string& name) {
    const double x_c = facts.at("circle").at("center").at(0);
    const double y_c = facts.at("circle").at("center").at(1);
    const double R = facts.at("circle").at("radius");
    const auto angle = [&](const json& p) {
        return std::atan2(p.at(1).get<double>() - y_c, p.at(0).get<double>() - x_c);
    };
    const double from = angle(facts.at("entry"));
    const double to = angle(facts.at("exit"));
    Series s{name, {}, {}};
    for (int i = 0; i <= 60; ++i) {
        const double theta = from + (to - from) * i / 60.0;
        s.x.push_back(x_c + R * std::cos(theta));
        s.y.push_back(y_c + R * std::sin(theta));
    }
    return s;
}

/// The optimised surface of straight pieces, where there is one.
void add_polyline(const json& facts, const std::string& name, Chart& chart) {
    const json polyline = facts.value("non_circular", json());
    if (polyline.is_null()) return;
    Series s{
        name + ", FS " +
            short_number(std::round(1e3 * polyline.at("factor_of_safety").get<double>()) / 1e3),
        {},
        {}};
    for (const json& point : polyline.at("points")) {
        s.x.push_back(point.at(0));
        s.y.push_back(point.at(1));
    }
    chart.series.push_back(s);
}

Figure section_with_circles(const json& scene, const json& result) {
    Chart chart{"Section and critical surfaces", {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
    for (const json& region : scene.at("section").at("regions")) {
        Series s{region.at("name"), {}, {}, Style::area};
        for (const json& p : region.at("polygon")) {
            s.x.push_back(p.at(0));
            s.y.push_back(p.at(1));
        }
        chart.series.push_back(s);
    }
    if (!result.contains("stages")) {
        chart.series.push_back(arc(result, "critical"));
        add_polyline(result, "non-circular", chart);
    }
    for (const json& stage : result.value("stages", json::array())) {
        chart.series.push_back(arc(
            stage,
            short_number(stage.at("liquefied_depth")) + " m liquefied, FS " +
                short_number(std::round(1e3 * stage.at("factor_of_safety").get<double>()) / 1e3)));
        add_polyline(stage, short_number(stage.at("liquefied_depth")) + " m, non-circular", chart);
    }
    return {"section_with_critical_surfaces", chart};
}

}  // namespace

std::vector<Figure> stability_figures(const std::filesystem::path& folder) {
    const json result = read_json(folder / phases::files::result);
    const json scene = read_json(folder / phases::files::scene);
    try {
        std::vector<Figure> figures = {section_with_circles(scene, result)};
        if (result.contains("stages")) figures.push_back(safety_against_depth(result));
        return figures;
    } catch (const json::exception& error) {
        throw fault::BadInput(folder.string(), {{"", error.what(), "give a lem_tool folder"}});
    }
}

}  // namespace breach::report
