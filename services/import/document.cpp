// Makes the scene from healed outlines. All entries that a drawing cannot give are guessed here,
// and listed in `guessed` with their reason, so that the user sees what to check.
#include "services/import/document.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/polyline.hpp"
#include "core/scene/resolution.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// To a micrometre; shared points of regions stay equal.
/// Same rounding for all regions: neighbours must share their points exactly.
double rounded(double value) { return std::round(1e6 * value) / 1e6; }

/// A scene's polygon repeats its first point; rings here do not.
json section_of(const std::vector<Soil>& soils, double element_size) {
    json regions = json::array();
    for (const Soil& each : soils) {
        json polygon = as_json(each.ring);
        polygon.push_back(polygon.front());
        regions.push_back({{"name", each.name},
                           {"material", each.material},
                           {"mesh", {{"type", "unstructured"}}},
                           {"polygon", polygon}});
    }
    return {{"element_size", element_size}, {"regions", regions}};
}

/// Regions that reach above the toe; lower ones are ground and do not run out.
/// Half a cell above the toe: ground whose top is drawn slightly above it must not count as runout.
json mobile_regions(const std::vector<Soil>& soils, const Vec2& toe, double cell) {
    json names = json::array();
    for (const Soil& each : soils)
        if (geometry::bounding_box(each.ring).high.y() > toe.y() + 0.5 * cell)
            names.push_back(each.name);
    return names;
}

/// Levels are whole cells away from the toe, two cells beyond soil and terrain: firm ground that is
/// level with the toe then ends at a line of the grid.
json mpm_of(const std::vector<Soil>& soils, const std::vector<Vec2>& terrain, const Vec2& toe,
            double cell) {
    geometry::Outlines all = outlines_of(soils);
    const double section_end = geometry::extent(all).low.x();
    all.push_back(&terrain);
    const geometry::Box box = geometry::extent(all);
    // 1e-9 of a cell: a level that is a multiple up to rounding must not gain another cell.
    const auto down = [&](double v) { return rounded(std::floor(v / cell + 1e-9) * cell); };
    const auto up = [&](double v) { return rounded(std::ceil(v / cell - 1e-9) * cell); };
    const double floor = rounded(toe.y() + down(box.low.y() - 2.0 * cell - toe.y()));
    const double top = rounded(toe.y() + up(box.high.y() + 2.0 * cell - toe.y()));
    // The wall touches the section's upstream end: soil would flow into a gap.
    const bool goes_on = box.low.x() < section_end - 2.0 * cell;
    const double left = goes_on ? down(box.low.x()) : rounded(section_end);
    const json domain_x{left, rounded(left + up(box.high.x() - left))};
    const json friction{{{"from", domain_x[0]}, {"to", domain_x[1]}, {"coefficient", 0.5}}};
    json mpm{{"cell_size", cell},
             {"domain_x", domain_x},
             {"domain_y", {floor, top}},
             {"floor", {{"level", floor}, {"friction", friction}}},
             {"terrain", as_json(terrain)},
             {"fill_points", scene::points_across_cell},
             {"fill_stress", "overburden"},
             {"overlap_correction", {{"rate", scene::usual_overlap_rate}}},
             {"duration", "until_rest"},
             {"runout", {{"toe", importing::as_json(toe)}}}};
    const json mobile = mobile_regions(soils, toe, cell);
    if (!mobile.empty() && mobile.size() < soils.size()) mpm["runout"]["regions"] = mobile;
    return mpm;
}

}  // namespace

json as_json(const Vec2& place) { return {rounded(place.x()), rounded(place.y())}; }

json as_json(const std::vector<Vec2>& line) {
    json list = json::array();
    for (const Vec2& each : line) list.push_back(as_json(each));
    return list;
}

/// Users may give a whole scene for its materials.
const json& materials_in(const json& document) {
    const bool holds = document.is_object() && document.contains("materials");
    return holds ? document.at("materials") : document;
}

/// The height of the slope sets the sizes: elements, cells, the search. Without a slope, the
/// thickest region does.
Document document_of(const std::string& name, const json& given, const std::vector<Soil>& soils,
                     const Lines& lines, double share) {
    const json& materials = materials_in(given);
    Document document;
    document.guessed = json::array();
    const auto guess = [&](const std::string& pointer, const json& value, const std::string& from) {
        document.guessed.push_back({{"pointer", pointer}, {"value", value}, {"from", from}});
    };
    const std::vector<Vec2> ground = ground_of(soils);
    const auto slope = document.slope = slope_of(ground);
    double height = 0.0;
    for (const Soil& each : soils) {
        const geometry::Box box = geometry::bounding_box(each.ring);
        height = std::max(height, box.high.y() - box.low.y());
    }
    if (slope) height = slope->fall();
    const double size = element_size_for(height);
    const double cell = rounded(share * std::min(size, cell_size_for(height)));
    guess("/section/element_size", size,
          slope ? "a fifteenth of the slope's height" : "a fifteenth of the thickest region");
    document.scene = {{"format", "breachline-scene/1"},
                      {"name", name},
                      {"materials", materials},
                      {"section", section_of(soils, size)}};
    const std::string from =
        slope ? "the ground between crest " + text(slope->crest) + " and toe " + text(slope->toe)
              : "";
    if (slope) {
        const Ranges ranges = ranges_of(*slope, ground);
        document.scene["lem"]["search"] = {{"entry", ranges.entry}, {"exit", ranges.exit}};
        guess("/lem/search/entry", ranges.entry, from);
        guess("/lem/search/exit", ranges.exit, from);
        if (!lines.phreatic.empty())
            document.scene["lem"]["water"]["line"] = as_json(lines.phreatic);
    } else {
        document.remarks.push_back(
            std::string("the ground has no slope to search: the scene has no /lem") +
            (lines.phreatic.empty() ? "" : ", and the phreatic line is in none of its parts"));
    }
    if (!lines.terrain.empty()) {
        const Vec2 toe = slope ? slope->toe : ground.back();
        document.scene["mpm"] = mpm_of(soils, lines.terrain, toe, cell);
        guess("/mpm/cell_size", cell,
              share < 1.0 ? "the thinnest layer, which needs two cells"
                          : "a twentieth of the height, as in \"breach new\"");
        const auto is_nonlocal = [](const json& each) { return each.contains("nonlocal_length"); };
        if (std::ranges::any_of(materials, is_nonlocal)) {
            json& length = document.scene["mpm"]["softening_length"];
            length = given.value("/mpm/softening_length"_json_pointer, json(cell));
            guess("/mpm/softening_length", length,
                  "the scene of the materials, else the cell size");
        }
        for (const char* entry : {"domain_x", "domain_y"})
            guess(std::string("/mpm/") + entry, document.scene["mpm"][entry],
                  "section and terrain, with two cells below and above");
        guess("/mpm/floor/friction", 0.5, "what is usual between soil and terrain");
        guess("/mpm/fill_points", scene::points_across_cell, "what \"breach new\" sets");
        guess("/mpm/overlap_correction/rate", scene::usual_overlap_rate,
              "what \"breach new\" sets");
        const json& runout = document.scene["mpm"]["runout"];
        guess("/mpm/runout/toe", runout["toe"], slope ? from : "the right end of the ground");
        if (runout.contains("regions"))
            guess("/mpm/runout/regions", runout["regions"], "what reaches above the toe");
    }
    if (!lines.ground.empty()) {
        double most = 0.0;
        Vec2 place = Vec2::Zero();
        for (const Vec2& each : lines.ground) {
            if (each.x() < ground.front().x() || each.x() > ground.back().x()) continue;
            const double off = std::abs(each.y() - geometry::level_at(ground, each.x()));
            if (off > most) most = off, place = each;
        }
        document.remarks.push_back("the ground line and the top of the regions differ by at most " +
                                   metres(most) + (most > 0.0 ? ", at " + text(place) : ""));
    }
    return document;
}

}  // namespace breach::importing
