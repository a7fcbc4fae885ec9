// From the scene's entries to one Soil per region, sound or liquefied. What a Soil says is applied
// slice by slice in slice_maker.cpp.
#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

/// Soil that cannot fail is closed.
Soil soil_of(const materials::Law& law) {
    const auto strength = materials::limit_strength(law);
    if (!strength) return {.c = 0.0, .tan_phi = 0.0, .passage = Soil::Passage::closed};
    return {.c = strength->c, .tan_phi = strength->tan_phi, .passage = Soil::Passage::open};
}

/// c and phi if constant, else s_u by place.
void give(const materials::StrengthCurve& curve, Soil& soil) {
    soil.passage = Soil::Passage::open;
    soil.coefficient = 0.0;
    const auto [c, tan_phi] = materials::strength_at(curve, {});
    soil.tan_phi = tan_phi;
    if (materials::is_uniform(curve)) {
        soil.c = c;
        soil.profile.reset();
    } else {
        soil.c = 0.0;
        soil.profile = std::make_shared<const materials::StrengthCurve>(curve);
    }
}

/// Sets phi = 0; sigma'_v0 still depends on the pore pressure.
void make_undrained(const scene::UndrainedRegion& entry, std::vector<Soil>& soils) {
    Soil& soil = soils[entry.region];
    if (entry.strength.by_state) {
        // Dry soil is not undrained.
        if (!soil.above_water) soil.above_water = std::make_shared<const Soil>(soil);
        soil.factor = entry.strength.factor;
    }
    soil.by_state = entry.strength.by_state;
    soil.c = entry.strength.constant;
    soil.tan_phi = 0.0;
    soil.passage = Soil::Passage::open;
    soil.coefficient = entry.strength.coefficient;
    soil.exponent = entry.strength.exponent;
    soil.profile.reset();
}

}  // namespace

Model make_model(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    Model model{make_strata(scene), {}, lem.slices, lem.seismic_coefficient};
    for (const scene::Region& region : scene.section.regions) {
        const scene::Material& material = scene.materials[region.material];
        model.soils.push_back(soil_of(material.law));
        const auto& profile = material.strength;
        if (materials::has_strength_of_points(material.law))
            give(profile->peak, model.soils.back());
        model.residual.push_back(profile ? profile->residual : std::nullopt);
    }
    const auto lines = lines_of_regions(scene);
    for (std::size_t i = 0; i < lines.size(); ++i) model.soils[i].line = lines[i];
    for (const scene::PorePressureRatio& each : lem.pore_pressure_ratios) {
        model.soils[each.region].r_u = each.r_u;
    }
    for (const scene::UndrainedRegion& each : lem.undrained) make_undrained(each, model.soils);
    return model;
}

std::vector<Soil> liquefied(const Model& model, const std::vector<scene::UndrainedRegion>& layers,
                            std::size_t count) {
    std::vector<Soil> soils = model.soils;
    for (std::size_t i = 0; i < count; ++i) {
        const scene::UndrainedRegion& layer = layers[i];
        Soil& soil = soils[layer.region];
        const auto sound = std::make_shared<const Soil>(model.soils[layer.region]);
        const auto& residual = model.residual[layer.region];
        if (residual && layer.strength.is_of_profile()) {
            soil.by_state.reset();
            give(*residual, soil);
            soil.factor = layer.strength.factor;
            if (!soil.profile) soil.c *= soil.factor;
        } else {
            make_undrained(layer, soils);
        }
        // Soil that was undrained before it liquefied has its drained strength above the water.
        soil.above_water = sound->above_water ? sound->above_water : sound;
    }
    return soils;
}

}  // namespace breach::lem
