#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

/// No surface passes through what cannot fail.
Soil soil_of(const materials::Law& law) {
    const auto strength = materials::limit_strength(law);
    if (!strength) return {0.0, 0.0, 0.0, Soil::Passage::closed};
    return {strength->c, strength->tan_phi, 0.0, Soil::Passage::open};
}

/// phi = 0; r_u still says what sigma'_v0 was.
void make_undrained(const scene::UndrainedRegion& entry, std::vector<Soil>& soils) {
    Soil& soil = soils[entry.region];
    soil = {entry.strength.constant, 0.0, soil.r_u, Soil::Passage::open, entry.strength.coefficient,
            entry.strength.exponent};
}

}  // namespace

Model make_model(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    Model model{make_strata(scene), {}, lem.slices, lem.seismic_coefficient};
    for (const scene::Region& region : scene.section.regions) {
        model.soils.push_back(soil_of(scene.materials[region.material].law));
    }
    for (const scene::PorePressureRatio& each : lem.pore_pressure_ratios) {
        model.soils[each.region].r_u = each.r_u;
    }
    for (const scene::UndrainedRegion& each : lem.undrained) make_undrained(each, model.soils);
    return model;
}

std::vector<Soil> liquefied(const Model& model, const std::vector<scene::UndrainedRegion>& layers,
                            std::size_t count) {
    std::vector<Soil> soils = model.soils;
    for (std::size_t i = 0; i < count; ++i) make_undrained(layers[i], soils);
    return soils;
}

}  // namespace breach::lem
