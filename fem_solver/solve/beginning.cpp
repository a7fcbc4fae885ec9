#include "fem_solver/solve/beginning.hpp"

#include <algorithm>
#include <limits>

#include "fem_solver/model/pore_water.hpp"

namespace breach::fem {
namespace {

/// Horizontal force that keeps the base nodes at rest.
Eigen::VectorXd base_reaction(const Model& model, const Motion& motion) {
    Eigen::VectorXd applied = model.external_force;
    add_pressure_force(model, motion.p, applied);
    Eigen::VectorXd missing = Eigen::VectorXd::Zero(model.dofs());
    for (std::size_t i = 0; i < model.constraints.is_base.size(); ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i);
        // Released without this force, the base would jump by the static shear on it.
        if (model.constraints.is_base[i]) missing[d] = motion.force[d] - applied[d];
    }
    return missing;
}

/// Average of -sigma'_yy over the present elements at a node, by volume; 0 if none.
std::vector<double> vertical_stress(const Model& model, const Motion& motion) {
    std::vector<double> sum(model.body.nodes, 0.0), volume(model.body.nodes, 0.0);
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        if (model.is_absent(e)) continue;
        for (std::size_t g = 0; g < model.points_per_element; ++g) {
            const double w = model.reference[e].weight[g];
            const double sigma_v = -motion.points[e * model.points_per_element + g].sigma[1];
            for (const std::int32_t node : model.mesh.quads[e]) {
                sum[node] += w * sigma_v;
                volume[node] += w;
            }
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
        if (volume[i] > 0.0) sum[i] /= volume[i];
    return sum;
}

/// Present K + 4G/3: from the memory, or elastic for laws without.
double modulus_of(const Model& model, const Motion& motion, const PorousElement& porous) {
    const Zone& zone = model.zones[porous.zone];
    double modulus = porous.skeleton_modulus;
    // Laws without memory: the elastic modulus of build_pore_water stays.
    if (motion.memory.empty()) return modulus;
    const std::size_t first = (porous.element - zone.first) * model.points_per_element;
    materials::with_memory(zone.law, motion.memory[porous.zone],
                           [&](const auto& law, const auto& points) {
                               modulus = elastic_tangent(law, points[first])(0, 0);
                           });
    return modulus;
}

/// See Model::s_u.
std::vector<double> undrained_strengths(const Model& model, const Motion& motion) {
    std::vector<double> s_u;
    for (const Zone& zone : model.zones) {
        if (!zone.dynamic_strength) continue;
        s_u.resize(model.points(), 0.0);
        const std::size_t begin = zone.first * model.points_per_element;
        for (std::size_t p = begin; p < begin + zone.count * model.points_per_element; ++p)
            s_u[p] = strength_at(*zone.dynamic_strength, {0.0, 0.0, -motion.points[p].sigma[1]}).c;
    }
    return s_u;
}

}  // namespace

Beginning beginning_of(const Model& model, const Motion& motion) {
    Beginning beginning;
    if (model.base.any()) beginning.base_reaction = base_reaction(model, motion);
    const bool wanted = model.water.any() || std::ranges::any_of(model.zones, [](const Zone& zone) {
                            return materials::has_state_parameter(zone.law);
                        });
    for (std::size_t p = 0; wanted && p < model.body.elements * model.points_per_element; ++p)
        beginning.sigma_v0_points.push_back(-motion.points[p].sigma[1]);
    beginning.s_u = undrained_strengths(model, motion);
    if (!model.water.any()) return beginning;
    beginning.p = motion.p;
    beginning.sigma_v0 = vertical_stress(model, motion);
    for (const PorousElement& each : model.water.elements) {
        beginning.skeleton_modulus.push_back(modulus_of(model, motion, each));
    }
    return beginning;
}

void apply_to_model(const Beginning& beginning, Model& model) {
    model.s_u = beginning.s_u;
    for (std::size_t i = 0; i < beginning.skeleton_modulus.size(); ++i) {
        model.water.elements[i].skeleton_modulus = beginning.skeleton_modulus[i];
    }
}

LateralStress lateral_stress(const Model& model, const Motion& motion) {
    // Sums over the points: only ratios of them are used.
    const auto mean_of = [&](std::size_t e) {
        Voigt mean = Voigt::Zero();
        for (std::size_t g = 0; g < model.points_per_element; ++g) {
            mean += motion.points[e * model.points_per_element + g].sigma;
        }
        return mean;
    };
    double largest = 0.0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        largest = std::max(largest, -mean_of(e)[1]);
    }
    LateralStress K{0.0, std::numeric_limits<double>::infinity(), 0.0};
    double volume = 0.0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        const Voigt sigma = mean_of(e);
        // Near the ground, and where soil is absent, the ratio has no meaning.
        if (-sigma[1] <= 0.01 * largest) continue;
        const double ratio = sigma[0] / sigma[1];
        K.average += model.volume[e] * ratio;
        volume += model.volume[e];
        K.least = std::min(K.least, ratio);
        K.largest = std::max(K.largest, ratio);
    }
    if (volume == 0.0) return {};
    K.average /= volume;
    return K;
}

}  // namespace breach::fem
