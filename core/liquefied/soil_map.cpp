#include "core/liquefied/soil_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/fault/fault.hpp"

namespace breach::liquefied {
namespace {

using exchange::MeshSnapshot;
using exchange::StressMeasure;

/// Section index of each region of the mesh; adds faults if the scene does not match.
std::vector<std::size_t> match_regions(const MeshSnapshot& mesh, const scene::Scene& scene,
                                       std::vector<fault::Fault>& faults) {
    const std::string remedy = "use the scene that the snapshot was made with";
    const auto& regions = scene.section.regions;
    std::vector<std::size_t> match;
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
        const std::string& name = mesh.regions[r];
        const auto region = std::ranges::find(regions, name, &scene::Region::name);
        match.push_back(static_cast<std::size_t>(region - regions.begin()));
        if (region == regions.end()) {
            faults.push_back({"/section/regions",
                              "the snapshot's region \"" + name + "\" is not in the scene",
                              remedy});
            continue;
        }
        const std::string& material = scene.materials[region->material].name;
        if (material == mesh.materials_of_regions[r]) continue;
        faults.push_back({"/section/regions/" + std::to_string(match.back()) + "/material",
                          "\"" + name + "\" is of \"" + material + "\" in the scene and of \"" +
                              mesh.materials_of_regions[r] + "\" in the snapshot",
                          remedy});
    }
    return match;
}

void check_snapshot(const MeshSnapshot& mesh, const scene::Scene& scene,
                    std::vector<fault::Fault>& faults) {
    const auto& liquefied = scene::transfer_of(scene).liquefied;
    if (!liquefied) return;
    const JudgedBy judged = judged_by(scene);
    if (judged.state) {
        if (!liquefied->layers.empty())
            faults.push_back({"/transfer/liquefied/layers",
                              "are by pore pressure, and NorSand's strengths come from its state",
                              "leave the layers out, or NorSand's regions"});
        if (mesh.psi.empty())
            faults.push_back({"/transfer/liquefied",
                              "the snapshot has no state parameter: its NorSand soil has not begun",
                              "give a snapshot of a stage with the scene's laws"});
    }
    if (judged.pressure && liquefied->by == scene::LiquefiedBy::point && mesh.r_u_max.empty())
        faults.push_back({"/transfer/liquefied/by",
                          "the snapshot has no largest r_u of its points: nothing has shaken yet",
                          "give a snapshot of a dynamic stage with pore water, or decide by "
                          "\"column\""});
    else if (judged.pressure && mesh.sigma_v0.empty())
        faults.push_back(
            {"/transfer/liquefied",
             "the snapshot has no sigma_v0 and pore_pressure_0, which show what has liquefied",
             "give a snapshot of a FEM with pore water, or remove this part"});
}

/// [regions of the section] without elements in the snapshot.
std::vector<bool> regions_gone(const MeshSnapshot& mesh, const scene::Scene& scene) {
    std::vector<bool> there(mesh.regions.size(), false);
    for (const std::int32_t region : mesh.region_of_element) there[region] = true;
    std::vector<bool> gone;
    for (const scene::Region& region : scene.section.regions) {
        const auto found = std::ranges::find(mesh.regions, region.name);
        gone.push_back(found == mesh.regions.end() || !there[found - mesh.regions.begin()]);
    }
    return gone;
}

/// The water table when the shaking began, to which r_u refers: of the FEM, else of the mapping;
/// empty if the scene has neither.
std::vector<Vec2> water_table_of(const scene::Scene& scene) {
    if (!scene.fem || !scene.fem->water) return scene::transfer_of(scene).phreatic_line;
    const auto& stages = scene.fem->stages;
    const auto shaking = std::ranges::find(stages, scene::StageKind::dynamic, &scene::Stage::kind);
    const auto last = static_cast<std::size_t>(shaking - stages.begin());
    return scene.fem->water_in(std::min(last, stages.size() - 1))->line;
}

}  // namespace

StressMeasure measure_for(const materials::Law& law, const scene::Scene& scene) {
    if (scene.mpm && scene.mpm->water) return StressMeasure::buoyant;
    const bool effective = materials::traits(law).frictional &&
                           scene.transfer->stress == scene::TransferredStress::effective;
    return effective ? StressMeasure::effective : StressMeasure::total;
}

SoilMap::SoilMap(const MeshSnapshot& mesh, const scene::Scene& scene, const std::string& file)
    : mesh_(mesh), ground_(scene, regions_gone(mesh, scene)) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    std::vector<fault::Fault> faults;
    const std::vector<std::size_t> match = match_regions(mesh, scene, faults);
    check_snapshot(mesh, scene, faults);
    if (!faults.empty()) throw fault::BadInput(file, faults);

    const std::vector<scene::Soil> soils = scene::soils_of(scene);
    for (const scene::Soil& soil : soils) {
        const scene::Material& material = scene.materials[soil.material];
        soils_.push_back({scene.section.regions[soil.region].name, material.name, material.law,
                          measure_for(material.law, scene), std::nullopt});
        if (materials::has_strength_of_points(material.law))
            soils_.back().strength = material.strength;
    }
    for (const std::size_t region : match) {
        if (const materials::Law& law = soils_[region].law; !materials::is_for_particles(law))
            faults.push_back(
                {"/section/regions/" + std::to_string(region) + "/material",
                 "\"" + soils_[region].material + "\" is " + materials::traits(law).type +
                     ", which particles cannot have",
                 "map \"" + soils_[region].region + "\" to another material in /transfer/mapping"});
        add_rule(scene, soils, region);
    }
    if (!faults.empty()) throw fault::BadInput(file, faults);
    phreatic_line_ = settings.phreatic_line;
    set_water(scene);
    if (!settings.liquefied) return;
    collapse_ = Collapse(mesh, scene, match);
    for (const scene::LiquefiedLayer& layer : settings.liquefied->layers)
        layer_ends_.push_back(layer.to);
    std::vector<char> can_liquefy;
    for (const RegionRule& rule : rules_) can_liquefy.push_back(rule.liquefies ? 1 : 0);
    if (std::ranges::count(can_liquefy, 1) == 0) return;
    const scene::LiquefiedZone& zone = *settings.liquefied;
    if (zone.by == scene::LiquefiedBy::point) {
        points_.emplace(mesh, zone.r_u, zone.shear_strain, water_table_of(scene));
        return;
    }
    columns_.emplace(mesh, can_liquefy, zone.r_u, zone.when, zone.narrowest_wall);
    columns_->keep_below(water_table_of(scene));
    for (const scene::LiquefiedLine& line : zone.lines)
        // Times come from text in the scene and from summed steps in the snapshot.
        if (std::abs(line.transfer_time - mesh.time) < 1e-6) columns_->add(line);
}

/// The pool stays where it is drawn, also where the base has moved; the soil's water moves with it.
void SoilMap::set_water(const scene::Scene& scene) {
    if (!scene.mpm || !scene.mpm->water) return;
    const Vec2 base(displacement_of_base(mesh_), 0.0);
    const bool kept = scene.transfer->base_displacement == scene::BaseDisplacement::kept;
    if (!kept) offset_ = base;
    if (!mesh_.pore_pressure_0.empty()) {
        steady_ = {mesh_.position_0, mesh_.quads, mesh_.pore_pressure_0};
        for (Vec2& node : steady_.position)
            if (kept) node += base;
    }
    water_ = scene::StandingWater(scene, steady_);
}

void SoilMap::add_rule(const scene::Scene& scene, const std::vector<scene::Soil>& soils,
                       std::size_t region) {
    const scene::Transfer& settings = *scene.transfer;
    const auto index = [&](std::size_t material) {
        return static_cast<std::int32_t>(std::ranges::find(soils, scene::Soil{region, material}) -
                                         soils.begin());
    };
    // soils_of lists the regions' own soils first, in the section's order.
    RegionRule rule{.soil = static_cast<std::int32_t>(region), .region = region};
    for (const scene::SoilMapping& each : settings.mapping)
        if (each.region == region && each.saturated) rule.saturated = index(*each.saturated);
    rule.collapses = collapses(scene, region);
    rule.liquefies = !rule.collapses && settings.liquefied &&
                     std::ranges::count(settings.liquefied->regions, region) > 0;
    if (rule.liquefies)
        for (const scene::LiquefiedLayer& layer : settings.liquefied->layers)
            rule.layers.push_back(index(layer.material));
    rules_.push_back(std::move(rule));
}

bool SoilMap::is_liquefied(std::size_t element, const Vec2& xi, const Vec2& place) const {
    return points_ ? points_->holds(element, xi, place) : columns_->holds(place);
}

std::optional<bool> SoilMap::liquefied_at(std::size_t element, const Vec2& xi) const {
    if (!rules_[mesh_.region_of_element[element]].liquefies) return std::nullopt;
    return is_liquefied(element, xi, undeformed_corners(mesh_, element) * shape_functions(xi));
}

std::int32_t SoilMap::at(std::size_t element, const Vec2& xi) const {
    const RegionRule& rule = rules_[mesh_.region_of_element[element]];
    if (!rule.saturated && rule.layers.empty()) return rule.soil;
    const Eigen::Vector4d N = shape_functions(xi);
    const Vec2 place = undeformed_corners(mesh_, element) * N;
    if (!rule.layers.empty() && is_liquefied(element, xi, place)) {
        const double sigma_v0 = corner_values(mesh_.sigma_v0, mesh_.quads[element]).dot(N);
        const auto layer = std::ranges::upper_bound(layer_ends_, sigma_v0) - layer_ends_.begin();
        // Stress beyond the last layer's end still belongs to that layer.
        return rule.layers[std::min(static_cast<std::size_t>(layer), rule.layers.size() - 1)];
    }
    // After the liquefied layers: soil that has liquefied is also saturated.
    if (rule.saturated && place.y() < geometry::level_at(phreatic_line_, place.x()))
        return *rule.saturated;
    return rule.soil;
}

std::optional<Collapse::Soil> SoilMap::state_at(std::size_t element, const Vec2& xi) const {
    const bool by_state = rules_[mesh_.region_of_element[element]].collapses &&
                          soils_[at(element, xi)].strength.has_value();
    return by_state ? collapse_.at(element, xi) : std::nullopt;
}

materials::PointStrength SoilMap::strength_at(std::size_t element, const Vec2& xi) const {
    const auto& profile = soils_[at(element, xi)].strength;
    if (!profile) return {};
    if (const auto soil = state_at(element, xi)) {
        const auto& [peak, residual] = soil->strength;
        // phi = 0: the MPM has total stress and no pore pressure, so the undrained strength is a
        // cohesion.
        return {soil->collapsed ? residual : peak, 0.0, residual, 0.0};
    }
    const RegionRule& rule = rules_[mesh_.region_of_element[element]];
    const Vec2 place = undeformed_corners(mesh_, element) * shape_functions(xi);
    const bool flows = rule.liquefies && is_liquefied(element, xi, place);
    return materials::strength_of_point(
        *profile, ground_.at(place, rule.region),
        flows ? materials::Liquefaction::liquefied : materials::Liquefaction::before);
}

std::optional<materials::Strength> SoilMap::limit_strength_at(std::size_t element,
                                                              const Vec2& xi) const {
    const SoilOfPoints& soil = soils_[at(element, xi)];
    const bool flows = liquefied_at(element, xi).value_or(false);
    if (soil.strength) {
        const materials::PointStrength s = strength_at(element, xi);
        if (flows) return materials::Strength{s.c_residual, s.tan_phi_residual};
        return materials::Strength{s.c, s.tan_phi};
    }
    const materials::Softening* softening = materials::softening(soil.law);
    if (flows && softening)
        return materials::Strength{softening->c_residual, softening->tan_phi_residual};
    return materials::limit_strength(soil.law);
}

}  // namespace breach::liquefied
