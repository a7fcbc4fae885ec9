#include "core/scene/softening.hpp"

#include <nlohmann/json.hpp>
#include <set>

namespace breach::scene {

double softening_scale_in_fem(const Material& soil, const Scene& scene) {
    if (!soil.nonlocal_length || !scene.mpm || !scene.mpm->softening_length) return 1.0;
    return *scene.mpm->softening_length / (band_in_nonlocal_lengths_of_fem * *soil.nonlocal_length);
}

nlohmann::json softening_in(const Scene& scene) {
    std::set<std::string> soils;
    bool has_length = false;
    for (const Region& region : scene.section.regions) {
        const Material& soil = scene.materials[region.material];
        if (!materials::softening(soil.law)) continue;
        soils.insert(soil.name);
        has_length |= soil.nonlocal_length.has_value();
    }
    if (soils.empty()) return nullptr;
    return {{"soils", soils}, {"has_length", has_length}};
}

}  // namespace breach::scene
