#include "core/scene/stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/resolution.hpp"

namespace breach::scene {

namespace {

/// Materials of points; ignores missing ones.
std::vector<const Material*> materials_of_points(const Scene& scene) {
    std::vector<const Material*> materials;
    for (const Soil& soil : soils_of(scene))
        if (soil.material < scene.materials.size())
            materials.push_back(&scene.materials[soil.material]);
    return materials;
}

double lowest_ground(const Mpm& mpm) {
    if (mpm.terrain.empty()) return mpm.floor.level;
    return std::ranges::min(mpm.terrain, {}, [](const Vec2& each) { return each.y(); }).y();
}

}  // namespace

double fall_speed(const Scene& scene, const Mpm& mpm) {
    const double top = mobile_extent(scene, mpm).high.y();
    return std::sqrt(2.0 * scene.gravity * std::max(top - lowest_ground(mpm), 0.0));
}

std::optional<double> wave_speed_limit(const Scene& scene, const Mpm& mpm) {
    const auto yields = [](const Material* each) { return materials::traits(each->law).yields; };
    const double fall = fall_speed(scene, mpm);
    if (mpm.time_step || mpm.shaking == Shaking::goes_on || !(fall > 0.0) ||
        std::ranges::none_of(materials_of_points(scene), yields))
        return std::nullopt;
    return waves_per_fall * fall;
}

mechanics::Elasticity elasticity_in_runout(const Material& material, const Mpm& mpm) {
    mechanics::Elasticity elasticity = materials::elasticity(material.law);
    elasticity.E *= mpm.stiffness_scale;
    if (!mpm.wave_speed_limit) return elasticity;
    return mechanics::slowed(elasticity, material.density, *mpm.wave_speed_limit);
}

double fastest_wave(const Scene& scene, const Mpm& mpm) {
    double fastest = 0.0;
    for (const Material* each : materials_of_points(scene))
        fastest = std::max(fastest, elasticity_in_runout(*each, mpm).wave_speed(each->density));
    return fastest;
}

}  // namespace breach::scene
