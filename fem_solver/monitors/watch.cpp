#include "fem_solver/monitors/watch.hpp"

#include <algorithm>

#include "core/mechanics/excess_pressure.hpp"
#include "fem_solver/model/pore_water.hpp"

namespace breach::fem {

process::Decided<std::optional<scene::LiquefactionWatch>> liquefaction_watch(
    const scene::Fem& fem) {
    return {fem.liquefaction,
            line_of("liquefied layers", process::use_if(fem.liquefaction.has_value()),
                    {"depth and r_u below the watched ground", "nothing is watched"},
                    "/fem/liquefaction")};
}

Watch::Watch(const scene::Fem& fem, const Model& model)
    : body_(model.mesh),
      failure_strain_(fem.failure_strain),
      failure_separation_(fem.failure_separation) {
    body_.nodes.resize(model.body.nodes);
    body_.quads.resize(model.body.elements);
    body_.region_of_element.resize(model.body.elements);
    if (const auto watched = liquefaction_watch(fem).value) {
        window_ = {watched->regions, watched->x, watched->level, watched->r_u};
        least_stress_ = watched->least_stress;
    }
    look_at(model);
}

void Watch::look_at(const Model& model) {
    std::vector<char> absent(body_.quads.size(), 0);
    present_ = {body_.nodes, {}, {}};
    for (std::size_t e = 0; e < absent.size(); ++e) {
        absent[e] = model.is_absent(e) ? 1 : 0;
        if (absent[e]) continue;
        present_.quads.push_back(body_.quads[e]);
        present_.region_of_element.push_back(body_.region_of_element[e]);
    }
    // With the numbers of all elements: bands and neighbours index epsilon_q of the whole body.
    ground_ = ground_of(body_, std::move(absent));
    nodes_ = nodes_in(present_, window_);
}

FailureSurfaces Watch::failure_surfaces(std::span<const double> epsilon_q) const {
    return failure_surfaces_of(body_, ground_, epsilon_q, failure_strain_, failure_separation_);
}

namespace {

/// Mean displacement of the sliding body relative to the intact rest [m]; 0 if none is separated.
double slip_across(const Model& model, const Motion& motion, const FailureSurfaces& surfaces) {
    Vec2 of_slide = Vec2::Zero(), of_rest = Vec2::Zero();
    double slide = 0.0, rest = 0.0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        // Without the bands themselves, whose displacement lies between those of the two bodies.
        if (surfaces.holds[e] || model.is_absent(e)) continue;
        const Dofs8 u = gather(model.mesh.quads[e], motion.u);
        const Vec2 moved = model.volume[e] * Eigen::Map<const Corners>(u.data()).rowwise().mean();
        (surfaces.slides[e] ? of_slide : of_rest) += moved;
        (surfaces.slides[e] ? slide : rest) += model.volume[e];
    }
    if (slide == 0.0 || rest == 0.0) return 0.0;
    return (of_slide / slide - of_rest / rest).norm();
}

}  // namespace

std::vector<double> Watch::excess_pressure(const Model& model, const Motion& motion,
                                           const Beginning& beginning) const {
    const std::size_t nodes = present_.nodes.size();
    const Eigen::VectorXd p = without_suction(model.water, motion.p);
    const Eigen::VectorXd p_0 = without_suction(model.water, beginning.p);
    return mechanics::nodal_excess_pressure(present_.nodes, present_.quads, {p.data(), nodes},
                                            {p_0.data(), nodes});
}

void Watch::read(const Model& model, const Motion& motion, const Beginning& beginning,
                 Reading& reading) const {
    const FailureSurfaces surfaces = failure_surfaces(epsilon_q_of_elements(model, motion));
    reading.failure_surfaces = static_cast<double>(surfaces.count);
    reading.slip_across_band = slip_across(model, motion, surfaces);
    if (beginning.p.size() > 0) read_water(model, motion, beginning, reading);
}

void Watch::read_water(const Model& model, const Motion& motion, const Beginning& beginning,
                       Reading& reading) const {
    double mass = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        // Prescribed pressures do not change and would dilute the mean.
        if (!model.water.is_unknown[i]) continue;
        const auto n = static_cast<Eigen::Index>(i);
        mass += model.nodal_mass[i];
        sum += model.nodal_mass[i] * (motion.p[n] - beginning.p[n]);
    }
    reading.excess_pressure_avg = mass > 0.0 ? sum / mass : 0.0;
    if (nodes_.empty()) return;
    const std::vector<double> excess = excess_pressure(model, motion, beginning);
    const std::vector<double> r_u = pore_pressure_ratio(excess, beginning.sigma_v0, least_stress_);
    for (const std::int32_t i : nodes_) reading.r_u_max = std::max(reading.r_u_max, r_u[i]);
    reading.liquefaction_depth = liquefaction_depth(body_, nodes_, r_u, window_);
}

}  // namespace breach::fem
