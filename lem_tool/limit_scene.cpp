// Three conversions, once per analysis: strength at failure replaces the laws, liquefying layers
// become regions of their own, and undrained paths of laws are computed.
#include "lem_tool/limit_scene.hpp"

#include <algorithm>
#include <sstream>

namespace breach::lem {
namespace {

/// The law of a material with a variable strength refers to the profile.
void use_limit_strength(scene::Material& material) {
    if (!material.limit_strength && !scene::lem_takes_profile(material)) return;
    materials::Plastic limit;
    if (material.limit_strength) {
        limit.c = material.limit_strength->c;
        limit.phi = material.limit_strength->phi;
    } else {
        const materials::StrengthCurve& peak = material.strength->peak;
        limit.c = materials::strength_at(peak, {10.0, 0.0, 1e5}).c;  // > 0 if it varies
        if (const auto* effective = std::get_if<materials::Effective>(&peak.kind))
            limit.phi = effective->phi;
        if (!materials::is_uniform(peak)) limit.strength_of = materials::StrengthOf::point;
    }
    material.law = materials::with_plasticity(material.law, limit);
}

/// Levels at which layers cut a region, from the top down, without its own top and bottom.
std::vector<double> cuts_of(const scene::Scene& scene, std::size_t region) {
    const geometry::Box box = geometry::bounding_box(scene.section.regions[region].polygon);
    const double near = 1e-9 * (box.high.y() - box.low.y());
    std::vector<double> cuts;
    for (const scene::UndrainedRegion& layer : scene.lem->liquefaction) {
        if (layer.region != region || !layer.levels) continue;
        for (const double level : *layer.levels) {
            if (level > box.low.y() + near && level < box.high.y() - near) cuts.push_back(level);
        }
    }
    std::sort(cuts.begin(), cuts.end(), std::greater<>());
    const auto same = [&](double a, double b) { return std::abs(a - b) <= near; };
    cuts.erase(std::unique(cuts.begin(), cuts.end(), same), cuts.end());
    return cuts;
}

std::string part_name(const std::string& region, const geometry::Polygon& part) {
    const geometry::Box box = geometry::bounding_box(part);
    std::ostringstream name;
    name << region << " (" << box.low.y() << " to " << box.high.y() << " m)";
    return name.str();
}

/// The region's parts between the cuts, from the top down.
std::vector<scene::Region> parts_of(const scene::Region& region, const std::vector<double>& cuts) {
    std::vector<scene::Region> parts;
    geometry::Polygon rest = region.polygon;
    for (const double level : cuts) {
        parts.push_back(region);
        parts.back().polygon = geometry::clipped_left(rest, {0.0, level}, {1.0, level});
        rest = geometry::clipped_left(rest, {1.0, level}, {0.0, level});
    }
    parts.push_back(region);
    parts.back().polygon = rest;
    if (parts.size() == 1) return parts;
    for (scene::Region& part : parts) part.name = part_name(region.name, part.polygon);
    return parts;
}

/// For each original region, its parts.
using Places = std::vector<std::vector<std::size_t>>;

/// One entry per part of its region between its levels.
std::vector<scene::UndrainedRegion> entries_for(const std::vector<scene::UndrainedRegion>& entries,
                                                const Places& places,
                                                const std::vector<scene::Region>& parts) {
    std::vector<scene::UndrainedRegion> result;
    for (const scene::UndrainedRegion& entry : entries) {
        for (const std::size_t place : places[entry.region]) {
            const geometry::Box box = geometry::bounding_box(parts[place].polygon);
            const double middle = 0.5 * (box.low.y() + box.high.y());
            if (entry.levels && (middle < (*entry.levels)[0] || middle > (*entry.levels)[1])) {
                continue;
            }
            result.push_back({place, entry.strength, {}});
        }
    }
    return result;
}

/// Replaces regions by their parts.
void rename_regions(const Places& places, std::vector<std::size_t>& regions) {
    std::vector<std::size_t> parts;
    for (const std::size_t region : regions)
        parts.insert(parts.end(), places[region].begin(), places[region].end());
    regions = std::move(parts);
}

/// Computes undrained paths once, for all variations of the strength.
void walk_paths(const scene::Scene& scene, std::vector<scene::UndrainedRegion>& entries) {
    for (scene::UndrainedRegion& each : entries) {
        if (!each.strength.on_path) continue;
        const scene::Material& material = scene.material_of(each.region);
        materials::if_state_parameter(material.law, [&](const auto& law) {
            each.strength.by_state = std::make_shared<const materials::UndrainedByPlace>(
                undrained_by_place(law, *each.strength.on_path));
        });
    }
}

}  // namespace

std::vector<std::vector<std::size_t>> undrained_parts(const scene::Scene& scene) {
    std::vector<std::vector<std::size_t>> parts;
    std::size_t next = 0;
    for (const scene::UndrainedRegion& entry : scene.lem->undrained) {
        parts.emplace_back(cuts_of(scene, entry.region).size() + 1);
        for (std::size_t& each : parts.back()) each = next++;
    }
    return parts;
}

scene::Scene limit_scene(const scene::Scene& scene) {
    scene::Scene result = scene;
    result.lem = scene::lem_of(scene);  // throws if /lem is missing
    walk_paths(scene, result.lem->undrained);
    walk_paths(scene, result.lem->liquefaction);
    for (scene::Material& material : result.materials) use_limit_strength(material);
    std::vector<scene::Region>& regions = result.section.regions;
    regions.clear();
    Places places;
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        places.emplace_back();
        for (scene::Region& part : parts_of(scene.section.regions[i], cuts_of(scene, i))) {
            places.back().push_back(regions.size());
            regions.push_back(std::move(part));
        }
    }
    scene::Lem& lem = *result.lem;
    lem.undrained = entries_for(lem.undrained, places, regions);
    lem.liquefaction = entries_for(lem.liquefaction, places, regions);
    // Stages count layers: an entry that names two parts, or none, would shift all stages after it.
    if (lem.liquefaction.size() != scene.lem->liquefaction.size()) {
        throw fault::BadInput(
            scene.name, {{"/lem/liquefaction", "has levels that are not one layer of their region",
                          "give levels within the region that do not overlap; a layer that is cut "
                          "by another's levels must name its own"}});
    }
    rename_regions(places, lem.unconsolidated);
    if (lem.water) rename_regions(places, lem.water->regions);
    for (scene::Water& each : lem.piezometric_lines) rename_regions(places, each.regions);
    lem.pore_pressure_ratios.clear();
    for (const scene::PorePressureRatio& each : scene.lem->pore_pressure_ratios) {
        for (const std::size_t place : places[each.region]) {
            lem.pore_pressure_ratios.push_back({place, each.r_u});
        }
    }
    return result;
}

}  // namespace breach::lem
