// Variants that run out over different ground, side by side at one scale.
#include <algorithm>
#include <array>

#include "core/phases/files.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/figures/particle_figures.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

const json* terrain_of(const PhaseFolder& mpm) {
    const json& settings = mpm.scene.at("mpm");
    return settings.contains("terrain") ? &settings.at("terrain") : nullptr;
}

/// The longest runout on each ground, in the order of the grounds' first variants.
std::vector<const PhaseFolder*> one_per_ground(const Run& run) {
    std::vector<const PhaseFolder*> found;
    for (const std::string& variant : variants_of(run)) {
        const auto runouts = runouts_of(run, variant);
        if (runouts.empty()) continue;
        const PhaseFolder* longest = *std::ranges::max_element(runouts, {}, runout_of);
        const json* terrain = terrain_of(*longest);
        const auto same = std::ranges::find_if(found, [&](const PhaseFolder* each) {
            const json* other = terrain_of(*each);
            return (!terrain && !other) || (terrain && other && *terrain == *other);
        });
        if (same == found.end())
            found.push_back(longest);
        else if (runout_of(longest) > runout_of(*same))
            *same = longest;
    }
    return found;
}

/// The ground between two x; without terrain the level floor.
Series ground_of(const PhaseFolder& mpm, const Range& shown) {
    Series s{"ground, " + mpm.variant, {}, {}};
    const json* terrain = terrain_of(mpm);
    if (!terrain) {
        const double level = mpm.scene.at("mpm").at("floor").at("level");
        return {s.name, {shown.low, shown.high}, {level, level}};
    }
    const auto at = [&](std::size_t k) { return (*terrain)[k].get<std::array<double, 2>>(); };
    const auto level = [&](std::size_t k, double x) {
        const auto [x0, y0] = at(k);
        const auto [x1, y1] = at(k + 1);
        return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    };
    const auto add = [&](double x, double y) { s.x.push_back(x), s.y.push_back(y); };
    const std::size_t edges = terrain->size() - 1;
    add(shown.low, level(0, shown.low));
    for (std::size_t k = 0; k <= edges; ++k) {
        const auto [x, y] = at(k);
        if (x > shown.low && x < shown.high) add(x, y);
    }
    std::size_t last = 0;
    while (last + 1 < edges && at(last + 1)[0] < shown.high) ++last;
    add(shown.high, level(last, shown.high));
    return s;
}

/// From the grid's left end to slightly beyond the farthest point of all runouts.
Range shown_by(const std::vector<const PhaseFolder*>& runouts) {
    constexpr double margin = 1.15;  // of the farthest point's distance from the toe
    const json& mpm = runouts.front()->scene.at("mpm");
    const double toe = mpm.at("runout").at("toe").at(0);
    Range range{mpm.at("domain_x").at(0), toe};
    for (const PhaseFolder* each : runouts) {
        const double farthest = each->result.at("runout_largest");
        range.high = std::max(range.high, toe + margin * std::max(farthest, 0.0));
    }
    return range;
}

/// A row of the table, and its place in a result.
struct Row {
    std::string what;
    std::string pointer;
    bool grows = false;  ///< while soil moves, so that it is a lower bound then
};

std::vector<Row> rows_of(const json& scene) {
    std::vector<Row> rows = {{"runout [m]", "/runout", true},
                             {"beyond the toe, 99 % [m]", "/runout_beyond_toe", true},
                             {"beyond the toe, 95 % [m]", "/runout_beyond_toe_95", true},
                             {"farthest point [m]", "/runout_largest", true},
                             {"at rest", "/at_rest"},
                             {"end [s]", "/end_time"}};
    for (const json& each : scene.at("mpm").value("gauges", json::array())) {
        const std::string name = each.at("name"), at = "/gauges/" + name;
        const std::string place = name + " (x = " + short_number(each.at("x")) + " m)";
        rows.push_back({"arrival at " + place + " [s]", at + "/arrival_time"});
        rows.push_back({"largest depth at " + place + " [m]", at + "/largest_depth", true});
    }
    return rows;
}

Table beside_each_other(const std::vector<const PhaseFolder*>& runouts,
                        const std::optional<Paper>& paper) {
    Table table{"ground",
                "Runout by ground",
                {"quantity"},
                {},
                "Arrival: seconds since the transfer; - when the flow never gets there, or had not "
                "yet. \u2265: a lower bound, the soil still moved."};
    for (const PhaseFolder* each : runouts) table.columns.push_back(of_transfer(*each));
    if (paper) table.columns.push_back("case history, valley of about 20 %");
    for (const Row& row : rows_of(runouts.front()->scene)) {
        std::vector<std::string> cells = {row.what};
        for (const PhaseFolder* each : runouts) {
            const std::string value = fact(each->result, row.pointer);
            cells.push_back(row.grows ? bounded(*each, value) : value);
        }
        if (paper) cells.push_back(row.pointer == "/runout" ? paper->case_history_runout : "");
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace

void add_ground(const Material& from, Document& document) {
    const auto runouts = one_per_ground(from.run);
    if (runouts.size() < 2) return;
    const Range shown = shown_by(runouts);
    Chapter chapter{"The ground below the dam",
                    "The same state on different ground, the longest runout on each, drawn on one "
                    "scale."};
    for (const PhaseFolder* each : runouts) {
        const auto file = exchange::read_particle_state(each->files / phases::files::final_state);
        Figure figure = points_by_material(file.state, "ground_" + each->variant,
                                           "Final geometry, " + of_transfer(*each));
        for (const PhaseFolder* other : runouts) {
            figure.chart.series.push_back(ground_of(*other, shown));
        }
        figure.chart.series.push_back(section_at_rest(each->scene));
        figure.caption += " Runout " + bounded(*each, fact(each->result, "/runout")) +
                          " m; lines: the section at rest and the ground of each variant.";
        chapter.figures.push_back(std::move(figure));
    }
    chapter.tables.push_back(beside_each_other(runouts, from.paper));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
