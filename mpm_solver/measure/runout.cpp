#include "mpm_solver/measure/runout.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/resolution.hpp"

namespace breach::mpm {

std::vector<std::uint8_t> mobile_regions(const scene::Scene& scene) {
    std::vector<std::uint8_t> mobile;
    for (const scene::Soil& soil : scene::soils_of(scene))
        mobile.push_back(
            scene::is_mobile(scene.section.regions[soil.region], scene::mpm_of(scene)) ? 1 : 0);
    return mobile;
}

double percentile(std::span<const std::pair<double, double>> x_and_mass, double share) {
    if (x_and_mass.empty()) return 0.0;
    double whole = 0.0;
    for (const auto& [x, mass] : x_and_mass) whole += mass;
    double below = 0.0;
    for (const auto& [x, mass] : x_and_mass) {
        below += mass;
        if (below >= share * whole) return x;
    }
    return x_and_mass.back().first;
}

Runout runout_of(const Points& points, const std::vector<std::uint8_t>& mobile, double toe_x) {
    std::vector<std::pair<double, double>> all;
    double volume_beyond = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!mobile[points.region[p]]) continue;
        const double distance = points.x[p] - toe_x;
        all.emplace_back(distance, points.m[p]);
        // Without open gaps, as depths are: spray would count as deposit.
        if (distance > 0.0) volume_beyond += points.soil_volume(p);
    }
    if (all.empty()) return {};
    std::sort(all.begin(), all.end());
    const auto first_beyond =
        std::find_if(all.begin(), all.end(), [](const auto& each) { return each.first > 0.0; });
    const std::span beyond(first_beyond, all.end());
    return {.all = percentile(all, 0.99),
            .beyond = percentile(beyond, 0.99),
            .beyond_95 = percentile(beyond, 0.95),
            .beyond_50 = percentile(beyond, 0.5),
            .largest = all.back().first,
            .all_by_count =
                all[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(all.size()))) - 1]
                    .first,
            .volume_beyond = volume_beyond};
}

}  // namespace breach::mpm
