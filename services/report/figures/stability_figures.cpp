#include "services/report/figures/stability_figures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/geometry/polyline.hpp"
#include "core/phases/files.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

Figure safety_against_depth(const json& result) {
    Series F{"least", {}, {}, Style::line_and_points};
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

/// The surface where its arc would go below the floor: along it, with its kinks. The corners, where the
/// two meet, lie on the chords.
Series held_by(const json& floor, const Series& arc) {
    if (floor.empty()) return arc;
    std::vector<mechanics::Vec2> line;
    for (const json& each : floor) line.emplace_back(each.at(0), each.at(1));
    Series s{arc.name, {}, {}};
    const auto add = [&](double x, double y) { s.x.push_back(x), s.y.push_back(y); };
    for (std::size_t i = 0; i < arc.x.size(); ++i) {
        add(arc.x[i], std::max(arc.y[i], geometry::level_at(line, arc.x[i])));
        if (i + 1 == arc.x.size()) break;
        const double x0 = arc.x[i], dx = arc.x[i + 1] - x0, dy = arc.y[i + 1] - arc.y[i];
        std::vector<double> places{0.0, 1.0};  // shares of the chord
        for (const mechanics::Vec2& each : line)
            if (const double t = (each.x() - x0) / dx; t > 0.0 && t < 1.0) places.push_back(t);
        std::ranges::sort(places);
        const auto above = [&](double t) {
            return arc.y[i] + t * dy - geometry::level_at(line, x0 + t * dx);
        };
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            const double begin = above(places[k]), end = above(places[k + 1]);
            if (begin * end < 0.0) {
                const double t = places[k] + (places[k + 1] - places[k]) * begin / (begin - end);
                add(x0 + t * dx, arc.y[i] + t * dy);
            }
            if (k + 2 < places.size() && end <= 0.0)
                add(x0 + places[k + 1] * dx, geometry::level_at(line, x0 + places[k + 1] * dx));
        }
    }
    return s;
}

/// The lower arc between its ends, 60 chords; where the floor is higher, along that.
Series arc(const json& facts, const json& floor, const std::string& name) {
    const double x_c = facts.at("circle").at("center").at(0);
    const double y_c = facts.at("circle").at("center").at(1);
    const double R = facts.at("circle").at("radius");
    const auto angle = [&](const json& p) {  // of an end on the floor that of the arc below it
        const double u = std::clamp((p.at(0).get<double>() - x_c) / R, -1.0, 1.0);
        return -std::acos(u);
    };
    const double from = angle(facts.at("entry"));
    const double to = angle(facts.at("exit"));
    Series s{name, {}, {}};
    for (int i = 0; i <= 60; ++i) {
        const double theta = from + (to - from) * i / 60.0;
        s.x.push_back(x_c + R * std::cos(theta));
        s.y.push_back(y_c + R * std::sin(theta));
    }
    return held_by(floor, s);
}

std::string with_factor(const std::string& name, const json& facts) {
    const double F = facts.at("factor_of_safety");
    return name + ", FS " + short_number(std::round(1e3 * F) / 1e3);
}

/// The surface of the answer, and beside it the other kinds that were analysed. `before`: "5.88 m, "
/// of a stage, or nothing.
void add_surfaces(const json& facts, const json& floor, const std::string& name,
                  const std::string& before, Chart& chart) {
    const std::string answer = facts.value("surface", "circle");
    if (facts.contains("circle"))
        chart.series.push_back(arc(facts, facts.value("floor", floor), name));
    const auto add_arc = [&](const char* key, const char* surface, const std::string& what) {
        const json other = facts.value(key, json());
        if (other.is_null() || answer == surface) return;
        chart.series.push_back(
            arc(other, other.value("floor", floor), with_factor(before + what, other)));
    };
    add_arc("bishop", "circle", "circle");
    add_arc("composite", "composite", "along weak layer");
    for (const auto& [key, kind] : {std::pair{"non_circular", "non-circular"},
                                    std::pair{"given_polyline", "given polyline"}}) {
        const json polyline = facts.value(key, json());
        if (polyline.is_null()) continue;
        Series s{with_factor(before + kind, polyline), {}, {}};
        for (const json& point : polyline.at("points")) {
            s.x.push_back(point.at(0));
            s.y.push_back(point.at(1));
        }
        chart.series.push_back(s);
    }
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
    const json floor = scene.value(json::json_pointer("/lem/floor"), json::array());
    if (!result.contains("stages")) add_surfaces(result, floor, "critical", "", chart);
    for (const json& stage : result.value("stages", json::array())) {
        const std::string depth = short_number(stage.at("liquefied_depth"));
        add_surfaces(stage, floor, with_factor(depth + " m liquefied", stage), depth + " m, ",
                     chart);
    }
    return {"section_with_critical_surfaces", chart};
}

}  // namespace

std::optional<Series> critical_surface(const json& scene, const json& result) {
    if (!result.is_object()) return {};
    Chart chart{};
    add_surfaces(result, scene.value(json::json_pointer("/lem/floor"), json::array()),
                 with_factor("slip surface", result), "", chart);
    if (chart.series.empty()) return {};
    return std::move(chart.series.front());
}

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
