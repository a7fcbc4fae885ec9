#include <cmath>
#include <variant>

#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

struct AsSoil {
    Soil operator()(const materials::LinearElastic&) const {
        return {0.0, 0.0, 0.0, Soil::Passage::closed};
    }
    Soil operator()(const materials::MohrCoulomb& law) const {
        return {law.c, std::tan(law.phi), 0.0, Soil::Passage::open};
    }
};

}  // namespace

Model make_model(const scene::Scene& scene) {
    const scene::Lem& lem = scene::lem_of(scene);
    Model model{make_strata(scene), {}, lem.slices, lem.seismic_coefficient};
    for (const scene::Region& region : scene.section.regions) {
        model.soils.push_back(std::visit(AsSoil{}, scene.materials[region.material].law));
    }
    for (const scene::PorePressureRatio& each : lem.pore_pressure_ratios) {
        model.soils[each.region].r_u = each.r_u;
    }
    return model;
}

std::vector<Soil> liquefied(const Model& model, const std::vector<scene::LiquefiedLayer>& layers,
                            std::size_t count) {
    std::vector<Soil> soils = model.soils;
    for (std::size_t i = 0; i < count; ++i) {
        soils[layers[i].region] = {layers[i].residual_strength, 0.0, 0.0, Soil::Passage::open};
    }
    return soils;
}

}  // namespace breach::lem
