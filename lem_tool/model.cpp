#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

/// No surface passes through what cannot fail.
Soil soil_of(const materials::Law& law) {
    const auto strength = materials::limit_strength(law);
    if (!strength) return {.c = 0.0, .tan_phi = 0.0, .passage = Soil::Passage::closed};
    return {.c = strength->c, .tan_phi = strength->tan_phi, .passage = Soil::Passage::open};
}

/// phi = 0; the pore pressure still says what sigma'_v0 was.
void make_undrained(const scene::UndrainedRegion& entry, std::vector<Soil>& soils) {
    Soil& soil = soils[entry.region];
    soil.c = entry.strength.constant;
    soil.tan_phi = 0.0;
    soil.passage = Soil::Passage::open;
    soil.coefficient = entry.strength.coefficient;
    soil.exponent = entry.strength.exponent;
}

/// Each region's phreatic line: its own, or /lem/water unless that is for other regions only.
void assign_lines(const scene::Lem& lem, std::vector<Soil>& soils) {
    std::size_t line = 0;
    if (lem.water) {
        if (lem.water->regions.empty()) {
            for (Soil& soil : soils) soil.line = line;
        }
        for (const std::size_t region : lem.water->regions) soils[region].line = line;
        ++line;
    }
    for (const scene::Water& each : lem.piezometric_lines) {
        for (const std::size_t region : each.regions) soils[region].line = line;
        ++line;
    }
}

}  // namespace

Model make_model(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    Model model{make_strata(scene), {}, lem.slices, lem.seismic_coefficient, lem.m_alpha};
    for (const scene::Region& region : scene.section.regions) {
        model.soils.push_back(soil_of(scene.materials[region.material].law));
    }
    assign_lines(lem, model.soils);
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
