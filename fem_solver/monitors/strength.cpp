#include "fem_solver/monitors/strength.hpp"

#include <algorithm>
#include <limits>

namespace breach::fem {

namespace {

/// [elements of the body] mean pore pressure, suction as 0 [Pa]; negative if an element does not
/// count.
std::vector<double> pressures(const Model& model, const Motion& motion) {
    const bool wet = model.water.any();
    std::vector<double> u(model.body.elements, wet ? -1.0 : 0.0);
    for (const PorousElement& each : model.water.elements) {
        if (each.element >= u.size()) continue;
        double sum = 0.0;
        for (const std::int32_t node : model.mesh.quads[each.element]) sum += motion.p[node];
        u[each.element] = std::max(0.25 * sum, 0.0);
    }
    return u;
}

}  // namespace

StrengthRatio strength_ratio(const Model& model, const Motion& motion, const Beginning& beginning) {
    StrengthRatio ratio{0.0, std::numeric_limits<double>::infinity()};
    if (beginning.sigma_v0_points.empty()) return {};
    const std::vector<double> u = pressures(model, motion);
    double volume = 0.0;
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        const Zone& zone = model.zones[z];
        const auto read = [&]<class Law>(const Law& law,
                                         const std::vector<typename Law::Memory>& points) {
            std::vector<typename Law::Memory> states;
            std::vector<double> bounds, weights, sigma_v0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const std::size_t e = zone.first + i / model.points_per_element;
                if (e >= model.body.elements || model.is_absent(e) || u[e] < 0.0) continue;
                const double before =
                    beginning.sigma_v0_points[zone.first * model.points_per_element + i];
                // The law does not follow stress below its least one; ratios there are without
                // meaning.
                if (before < least_mean_stress(law)) continue;
                const Voigt sigma = stress(law, points[i]);
                states.push_back(points[i]);
                // p' + u: an undrained strength above that would need suction.
                bounds.push_back(-(sigma[0] + sigma[1] + sigma[2]) / 3.0 + u[e]);
                weights.push_back(model.reference[e].weight[i % model.points_per_element]);
                sigma_v0.push_back(before);
            }
            const auto strengths = undrained_strengths(law, states, bounds);
            for (std::size_t i = 0; i < strengths.size(); ++i) {
                const double each = strengths[i].peak / sigma_v0[i];
                volume += weights[i];
                ratio.average += weights[i] * each;
                ratio.least = std::min(ratio.least, each);
            }
        };
        materials::with_state(zone.law, motion.memory[z], read);
    }
    if (volume == 0.0) return {};
    ratio.average /= volume;
    return ratio;
}

}  // namespace breach::fem
