#include <cmath>
#include <variant>

#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

struct AsSoil {
    Soil operator()(const materials::LinearElastic&) const {
        return {0.0, 0.0, Soil::Passage::closed};
    }
    Soil operator()(const materials::MohrCoulomb& law) const {
        return {law.c, std::tan(law.phi), Soil::Passage::open};
    }
};

}  // namespace

Model make_model(const scene::Scene& scene) {
    Model model{make_strata(scene), {}, scene::lem_of(scene).slices};
    for (const scene::Region& region : scene.section.regions) {
        model.soils.push_back(std::visit(AsSoil{}, scene.materials[region.material].law));
    }
    return model;
}

}  // namespace breach::lem
