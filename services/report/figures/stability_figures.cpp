#include "services/report/figures/stability_figures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/geometry/polygon.hpp"
#include "core/geometry/polyline.hpp"
#include "core/phases/files.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;
using namespace nlohmann::literals;

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

/// The surface with the floor in place of the arc below it. The corners where both meet lie on the
/// chords.
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

/// The lower arc between its ends, 60 chords; follows the floor where that is higher.
Series arc(const json& facts, const json& floor, const std::string& name) {
    const double x_c = facts.at("circle").at("center").at(0);
    const double y_c = facts.at("circle").at("center").at(1);
    const double R = facts.at("circle").at("radius");
    const auto angle = [&](const json& p) {  // of an end on the floor: angle of the arc below it
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

void add_answer(const json& facts, const json& floor, const std::string& name, Chart& chart) {
    if (facts.contains("circle"))
        chart.series.push_back(arc(facts, facts.value("floor", floor), name));
}

/// Adds the other kinds of surface that were analysed.
void add_other_kinds(const json& facts, const json& floor, Chart& chart) {
    const std::string answer = facts.value("surface", "circle");
    const auto add_arc = [&](const char* key, const char* surface, const std::string& what) {
        const json other = facts.value(key, json());
        if (other.is_null() || answer == surface) return;
        chart.series.push_back(arc(other, other.value("floor", floor), with_factor(what, other)));
    };
    add_arc("bishop", "circle", "circle");
    add_arc("composite", "composite", "along weak layer");
    for (const auto& [key, kind] : {std::pair{"non_circular", "non-circular"},
                                    std::pair{"given_polyline", "given polyline"}}) {
        const json polyline = facts.value(key, json());
        if (polyline.is_null()) continue;
        chart.series.push_back(line_of(polyline.at("points"), with_factor(kind, polyline)));
    }
}

/// The part of a curve between two x.
Series between(Series s, double from, double to) {
    geometry::Polygon ring;
    for (std::size_t i = 0; i + 1 < s.x.size(); ++i) ring.emplace_back(s.x[i], s.y[i]);
    ring = geometry::clipped_left(ring, {from, 1.0}, {from, 0.0});
    ring = geometry::clipped_left(ring, {to, 0.0}, {to, 1.0});
    s.x.clear();
    s.y.clear();
    for (const mechanics::Vec2& each : ring) s.x.push_back(each.x()), s.y.push_back(each.y());
    return s;
}

Series within(const Series& line, double from, double to) {
    std::vector<mechanics::Vec2> places;
    for (std::size_t i = 0; i < line.x.size(); ++i) places.emplace_back(line.x[i], line.y[i]);
    from = std::max(from, line.x.front());
    to = std::min(to, line.x.back());
    Series part{line.name, {from}, {geometry::level_at(places, from)}};
    for (const mechanics::Vec2& each : places) {
        if (each.x() <= from || each.x() >= to) continue;
        part.x.push_back(each.x());
        part.y.push_back(each.y());
    }
    part.x.push_back(to);
    part.y.push_back(geometry::level_at(places, to));
    return part;
}

Figure section_with_circles(const json& scene, const json& result) {
    Chart chart{"Section and critical surfaces", {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
    const json floor = scene.value(json::json_pointer("/lem/floor"), json::array());
    const json stages = result.value("stages", json::array());
    if (stages.empty()) add_answer(result, floor, "critical", chart);
    for (const json& stage : stages) {
        const std::string depth = rounded(stage.at("liquefied_depth"), 3);
        add_answer(stage, floor, with_factor(depth + " m liquefied", stage), chart);
        const std::size_t n = chart.series.size();  // a deeper layer may not change the surface
        if (n > 1 && chart.series[n - 1].x == chart.series[n - 2].x &&
            chart.series[n - 1].y == chart.series[n - 2].y)
            chart.series.pop_back();
    }
    add_other_kinds(stages.empty() ? result : stages.front(), floor, chart);

    // Shows only the part where soil slides, so that one scale suffices.
    double from = 1e300, to = -1e300;
    for (const Series& each : chart.series)
        for (const double x : each.x) from = std::min(from, x), to = std::max(to, x);
    const double margin = from < to ? 0.25 * (to - from) : 1e300;
    std::vector<Series> soil;
    for (const json& region : scene.at("section").at("regions")) {
        Series s = line_of(region.at("polygon"), region.at("name"));
        s.style = Style::area;
        s = between(std::move(s), from - margin, to + margin);
        if (!s.x.empty()) soil.push_back(std::move(s));
    }
    Series water =
        line_of(scene.value("/lem/water/line"_json_pointer, json::array()), "phreatic line");
    if (!water.x.empty()) soil.push_back(within(water, from - margin, to + margin));
    chart.series.insert(chart.series.begin(), soil.begin(), soil.end());
    return {"section_with_critical_surfaces", chart};
}

}  // namespace

Series line_of(const json& points, const std::string& name) {
    Series s{name, {}, {}};
    for (const json& point : points) {
        s.x.push_back(point.at(0));
        s.y.push_back(point.at(1));
    }
    return s;
}

std::optional<Series> critical_surface(const json& scene, const json& result) {
    if (!result.is_object()) return {};
    Chart chart{};
    add_answer(result, scene.value(json::json_pointer("/lem/floor"), json::array()),
               with_factor("slip surface", result), chart);
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
