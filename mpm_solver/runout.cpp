#include "mpm_solver/runout.hpp"

#include <algorithm>
#include <limits>

namespace breach::mpm {

std::vector<std::uint8_t> mobile_regions(const scene::Scene& scene) {
    const auto& names = scene::mpm_of(scene).runout.regions;
    std::vector<std::uint8_t> mobile;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        const std::string& region = scene.section.regions[soil.region].name;
        const bool counts =
            names.empty() || std::find(names.begin(), names.end(), region) != names.end();
        mobile.push_back(counts ? 1 : 0);
    }
    return mobile;
}

double percentile(std::vector<std::pair<double, double>>& x_and_mass, double share) {
    if (x_and_mass.empty()) return 0.0;
    std::sort(x_and_mass.begin(), x_and_mass.end());
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
    std::vector<std::pair<double, double>> beyond;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!mobile[points.region[p]]) continue;
        const double distance = points.x[p] - toe_x;
        all.emplace_back(distance, points.m[p]);
        if (distance > 0.0) beyond.emplace_back(distance, points.m[p]);
        largest = std::max(largest, distance);
    }
    if (all.empty()) return {};
    return {percentile(all, 0.99), percentile(beyond, 0.99), largest};
}

}  // namespace breach::mpm
