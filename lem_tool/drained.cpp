#include "lem_tool/drained.hpp"

#include <algorithm>

#include "core/geometry/polyline.hpp"

namespace breach::lem {

namespace {

/// The loosest state parameter of the law's beginning; of a void ratio that at 100 kPa [-].
double loosest(const materials::NorSand& law) {
    constexpr double p = 100e3;  // [Pa]
    if (law.e_0) return *law.e_0 - materials::norsand::critical_void_ratio(law.ready, p);
    if (!law.psi_0_profile) return law.psi_0.value_or(0.0);
    const auto& points = law.psi_0_profile->points;
    return std::ranges::max(points, {}, [](const auto& each) { return each[1]; })[1];
}

bool reaches_below(const scene::Region& region, const std::vector<scene::Vec2>& line) {
    return std::ranges::any_of(region.polygon, [&](const scene::Vec2& corner) {
        return corner.y() < geometry::level_at(line, corner.x());
    });
}

bool names(const std::vector<scene::UndrainedRegion>& entries, std::size_t region) {
    return std::ranges::count(entries, region, &scene::UndrainedRegion::region) > 0;
}

}  // namespace

std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene) {
    std::vector<fault::Flag> flags;
    const scene::Lem& lem = scene::lem_of(scene);
    if (!lem.water) return flags;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Region& region = scene.section.regions[r];
        const auto* law = std::get_if<materials::NorSand>(&scene.materials[region.material].law);
        if (!law || loosest(*law) <= 0.0 || names(lem.undrained, r) || names(lem.liquefaction, r))
            continue;
        if (!reaches_below(region, lem.water->line)) continue;
        flags.push_back(
            {"drained_only", fault::Severity::questionable,
             "region \"" + region.name +
                 "\" is of NorSand looser than critical and wet, and judged by its drained "
                 "strength alone: it can fail undrained at a factor of safety far above 1; give {"
                 "\"region\": \"" +
                 region.name + R"(", "norsand": "peak"} in /lem/undrained)",
             "/lem/undrained"});
    }
    return flags;
}

}  // namespace breach::lem
