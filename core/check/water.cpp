#include <algorithm>
#include <cmath>

#include "core/check/segment.hpp"
#include "core/check/subjects.hpp"

namespace breach::check {

namespace {

using scene::GroundWater;

/// Depth below the line from which some element of a region is certainly saturated [m].
double certainly_wet(const GroundWater& water, const scene::Region& region) {
    // "drained": one saturated node is enough; "dry": the centre must be below the line.
    return water.above == scene::AboveWater::dry ? element_size(region)
                                                 : 1e-6 * element_size(region);
}

void check_wet_soil(const scene::Scene& scene, const GroundWater& water,
                    std::vector<std::size_t>& told, Problems& problems) {
    for (const scene::Region& region : scene.section.regions) {
        const scene::Material* material = material_of(scene, region);
        if (region.polygon.empty() || material == nullptr) continue;
        const Depth deepest = deepest_below(region.polygon, water.line, level_at);
        if (deepest.below <= certainly_wet(water, region)) continue;
        if (material->void_ratio && material->permeability) continue;
        if (std::ranges::find(told, region.material) != told.end()) continue;
        told.push_back(region.material);
        const std::string lacks = material->void_ratio     ? "permeability"
                                  : material->permeability ? "void_ratio"
                                                           : "void_ratio and permeability";
        refuse(problems, "/materials/" + material->name,
               "lacks " + lacks + ", and \"" + region.name + "\" reaches " + metres(deepest.below) +
                   " below the phreatic line at " + text(deepest.place),
               "give " + lacks + ", lower the line there, or leave out /fem/water");
    }
}

void check_boundaries(const scene::Scene& scene, const GroundWater& water, Problems& problems) {
    if (scene.fem->mesh.msh_file) return;
    const double tolerance = 1e-6 * least_element_size(scene);
    for (std::size_t i = 0; i < water.boundaries.size(); ++i) {
        const scene::PressureBoundary& boundary = water.boundaries[i];
        const Side segment{boundary.from, boundary.to};
        if (may_hold_nodes(scene, segment, tolerance)) continue;
        refuse(problems, "/fem/water/boundaries/" + std::to_string(i),
               "\"" + boundary.name + "\" " + how_it_misses(scene, segment),
               "let the segment run along an edge of a region, ends included");
    }
}

/// Whether the region has soil between these abscissae.
bool lies_between(const scene::Region& region, const std::array<double, 2>& x) {
    if (region.polygon.empty()) return false;
    const geometry::Box box = geometry::bounding_box(region.polygon);
    return box.high.x() >= x[0] && box.low.x() <= x[1];
}

void check_watch(const scene::Scene& scene, Problems& problems) {
    const scene::LiquefactionWatch& watch = *scene.fem->liquefaction;
    bool seen = false, wet = false;
    for (const std::size_t r : watch.regions) {
        if (r >= scene.section.regions.size()) return;  // reported by the reader
        const scene::Region& region = scene.section.regions[r];
        if (!lies_between(region, watch.x)) continue;
        seen = true;
        wet = wet || deepest_below(region.polygon, scene.fem->water->line, level_at).below > 0.0;
    }
    if (!seen) {
        refuse(problems, "/fem/liquefaction/x",
               "no soil of these regions lies between " + metres(watch.x[0]) + " and " +
                   metres(watch.x[1]),
               "the section reaches from " + metres(extent(scene.section).low.x()) + " to " +
                   metres(extent(scene.section).high.x()) +
                   ": give a range that holds these regions");
    } else if (!wet) {
        refuse(problems, "/fem/liquefaction/regions", "lie above the phreatic line throughout",
               "name regions that have soil below /fem/water/line");
    }
}

/// Whether the line lies beside the section: there it would be level, at the height of its end.
bool is_beside(const scene::Scene& scene, const std::vector<Vec2>& line) {
    const geometry::Box box = extent(scene.section);
    return line.size() > 1 && (line.back().x() <= box.low.x() || line.front().x() >= box.high.x());
}

/// Water lines of stages: only within soil that exists in the stage.
void check_lines(const scene::Scene& scene, std::vector<std::size_t>& told, Problems& problems) {
    const auto& regions = scene.section.regions;
    for (std::size_t i = 0; i < scene.fem->stages.size(); ++i) {
        const auto& line = scene.fem->stages[i].phreatic_line;
        if (!line || line->empty()) continue;
        const std::string pointer = "/fem/stages/" + std::to_string(i) + "/phreatic_line";
        if (!check_table(scene, *line, pointer, problems)) continue;
        const GroundWater water = *scene.fem->water_in(i);
        check_wet_soil(scene, water, told, problems);
        const std::vector<bool> gone = scene.fem->regions_gone(regions.size(), i);
        for (std::size_t r = 0; r < regions.size(); ++r) {
            if (!gone[r] || regions[r].polygon.empty()) continue;
            const Depth depth = deepest_below(regions[r].polygon, *line, level_at);
            if (depth.below <= certainly_wet(water, regions[r])) continue;
            refuse(problems, pointer,
                   "stands " + metres(depth.below) + " above " + text(depth.place) + " of \"" +
                       regions[r].name + "\", which is not there in this stage",
                   "draw the line below \"" + regions[r].name +
                       "\", or move the water in a stage in which it is there");
        }
    }
}

}  // namespace

bool check_table(const scene::Scene& scene, const std::vector<Vec2>& line,
                 const std::string& pointer, Problems& problems) {
    const geometry::Box box = extent(scene.section);
    if (is_beside(scene, line)) {
        refuse(problems, pointer,
               "runs from x = " + metres(line.front().x()) + " to " + metres(line.back().x()) +
                   ", beside the section",
               "the section reaches from " + metres(box.low.x()) + " to " + metres(box.high.x()) +
                   ": draw the line over it");
        return false;
    }
    const Depth deepest = deepest_below(scene.section, line, level_at);
    if (deepest.below >= -1e-9 * (box.high.y() - box.low.y())) return true;
    refuse(problems, pointer,
           "runs below all soil, by at least " + metres(-deepest.below) +
               " at x = " + metres(deepest.place.x()),
           "raise the line above the section's lowest level, " + metres(box.low.y()));
    return false;
}

void warn_about_ends(const scene::Scene& scene, const std::vector<Vec2>& line,
                     const std::string& pointer, Problems& problems) {
    if (line.empty()) return;
    const geometry::Box box = extent(scene.section);
    const double shallow = 0.02 * (box.high.y() - box.low.y());
    const auto look = [&](const Vec2& end, double from, double to) {
        if (from >= to) return;
        const double depth = end.y() - ground_over(scene.section, from, to).lowest;
        if (depth <= shallow) return;
        warn(problems, "undrawn_water", pointer,
             "ends at " + text(end) + " and continues level from there: the water is up to " +
                 metres(depth) + " above the ground between x = " + text(from) + " and " +
                 metres(to) +
                 ", and supports the slope; extend the line to the section's edge, along the "
                 "ground where there is no water");
    };
    look(line.front(), box.low.x(), std::min(line.front().x(), box.high.x()));
    look(line.back(), std::max(line.back().x(), box.low.x()), box.high.x());
}

void check_water(const scene::Scene& scene, Problems& problems) {
    if (!scene.fem->water || scene.fem->water->line.empty()) return;
    const GroundWater& water = *scene.fem->water;
    check_boundaries(scene, water, problems);
    const Depth deepest = deepest_below(scene.section, water.line, level_at);
    if (deepest.below <= 0.0) {
        refuse(problems, "/fem/water/line",
               "runs below all soil, by at least " + metres(-deepest.below) +
                   " at x = " + metres(deepest.place.x()),
               "raise the line above the section's lowest level, " +
                   metres(extent(scene.section).low.y()) + ", or leave out /fem/water");
        return;
    }
    std::vector<std::size_t> told;
    check_wet_soil(scene, water, told, problems);
    warn_about_ends(scene, water.line, "/fem/water/line", problems);
    check_lines(scene, told, problems);
    if (scene.fem->liquefaction) check_watch(scene, problems);
}

}  // namespace breach::check
