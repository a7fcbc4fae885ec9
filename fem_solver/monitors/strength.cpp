#include "fem_solver/monitors/strength.hpp"

#include <algorithm>
#include <limits>

#include "core/materials/norsand/undrained.hpp"

namespace breach::fem {

namespace {

namespace norsand = materials::norsand;

/// [elements of the body] mean pore pressure where it is more than suction [Pa]; negative where an
/// element does not count.
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
    std::vector<norsand::State> states;
    std::vector<double> bounds, weights, sigma_v0;
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        const Zone& zone = model.zones[z];
        const auto* law = std::get_if<materials::NorSand>(&zone.law);
        if (law == nullptr) continue;
        const auto& points =
            std::get<materials::ZoneMemory<materials::NorSand>>(motion.memory[z]).points;
        states.clear(), bounds.clear(), weights.clear(), sigma_v0.clear();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t e = zone.first + i / model.points_per_element;
            if (e >= model.body.elements || model.is_absent(e) || u[e] < 0.0) continue;
            const double before =
                beginning.sigma_v0_points[zone.first * model.points_per_element + i];
            if (before < law->ready.parameters.p_min) continue;
            const norsand::State& s = points[i];
            states.push_back(s);
            bounds.push_back((s.xx + s.yy + s.zz) / 3.0 + u[e]);
            weights.push_back(model.reference[e].weight[i % model.points_per_element]);
            sigma_v0.push_back(before);
        }
        const auto strengths = norsand::undrained_strengths(law->ready, states, bounds);
        for (std::size_t i = 0; i < strengths.size(); ++i) {
            const double each = strengths[i].peak / sigma_v0[i];
            volume += weights[i];
            ratio.average += weights[i] * each;
            ratio.least = std::min(ratio.least, each);
        }
    }
    if (volume == 0.0) return {};
    ratio.average /= volume;
    return ratio;
}

}  // namespace breach::fem
