#include "fem_solver/model/nonlocal.hpp"

#include <algorithm>
#include <numeric>

#include "core/materials/nonlocal.hpp"

namespace breach::fem {

namespace {

/// Means over the points of an element.
struct ElementMeans {
    double epsilon_q;  ///< before the step [-]
    double growth;     ///< [-]
};

ElementMeans means_of(const Model& model, std::size_t element, const Motion& old,
                      const Motion& trial) {
    ElementMeans means{0.0, 0.0};
    double volume = 0.0;
    for (std::size_t g = 0; g < model.points_per_element; ++g) {
        const std::size_t p = element * model.points_per_element + g;
        const double V = model.reference[element].weight[g];
        means.epsilon_q += V * old.points[p].epsilon_q;
        means.growth += V * (trial.points[p].epsilon_q - old.points[p].epsilon_q);
        volume += V;
    }
    return {means.epsilon_q / volume, means.growth / volume};
}

}  // namespace

NonlocalSoftening::Group NonlocalSoftening::group_of(const Model& model, const Zone& zone) {
    Group group{.first = zone.first,
                .spent = materials::spent_strain(*materials::softening(zone.law)),
                .scale = zone.softening_scale,
                .rows = {0},
                .neighbours = {},
                .weights = {}};
    std::vector<Vec2> middles;
    for (std::size_t e = zone.first; e < zone.first + zone.count; ++e)
        middles.emplace_back(corners_of(model.mesh, e).rowwise().mean());
    const auto x_of = [&](std::int32_t i) { return middles[static_cast<std::size_t>(i)].x(); };
    // In order of x, so that neighbours lie in one range.
    std::vector<std::int32_t> sorted(middles.size());
    std::iota(sorted.begin(), sorted.end(), 0);
    std::ranges::stable_sort(sorted, {}, x_of);
    const double reach = materials::nonlocal_reach * zone.nonlocal_length;
    for (const Vec2& here : middles) {
        const auto begin = std::ranges::lower_bound(sorted, here.x() - reach, {}, x_of);
        const auto end = std::ranges::upper_bound(sorted, here.x() + reach, {}, x_of);
        for (const std::int32_t other : std::ranges::subrange(begin, end)) {
            const double distance = (middles[static_cast<std::size_t>(other)] - here).norm();
            if (distance == 0.0 || distance >= reach) continue;
            group.neighbours.push_back(other);
            group.weights.push_back(materials::nonlocal_weight(distance, zone.nonlocal_length));
        }
        group.rows.push_back(group.neighbours.size());
    }
    return group;
}

NonlocalSoftening::NonlocalSoftening(const Model& model) {
    for (const Zone& zone : model.zones)
        if (zone.nonlocal_length > 0.0) groups_.push_back(group_of(model, zone));
}

void NonlocalSoftening::share(const Model& model, const Motion& old, Motion& trial) const {
    for (const Group& group : groups_) share(group, model, old, trial);
}

void NonlocalSoftening::share(const Group& group, const Model& model, const Motion& old,
                              Motion& trial) const {
    std::vector<double> V(group.count(), 0.0), V_dk(group.count(), 0.0);
    bool grows = false;
    for (std::size_t i = 0; i < group.count(); ++i) {
        const std::size_t e = group.first + i;
        if (model.is_absent(e)) continue;
        const ElementMeans means = means_of(model, e, old, trial);
        grows = grows || means.growth != 0.0;
        if (means.epsilon_q >= group.spent) continue;
        V[i] = model.volume[e];
        V_dk[i] = V[i] * means.growth;
    }
    if (!grows) return;
    for (std::size_t i = 0; i < group.count(); ++i) {
        double around = 0.0, given = 0.0;
        for (std::size_t k = group.rows[i]; V[i] > 0.0 && k < group.rows[i + 1]; ++k) {
            const auto j = static_cast<std::size_t>(group.neighbours[k]);
            around += group.weights[k] * V[j];
            given += group.weights[k] * V_dk[j];
        }
        for (std::size_t g = 0; g < model.points_per_element; ++g) {
            const std::size_t p = (group.first + i) * model.points_per_element + g;
            const double before = old.points[p].epsilon_q;
            // An element without others around keeps its own growth.
            const double growth =
                around > 0.0 ? given / around : trial.points[p].epsilon_q - before;
            trial.points[p].epsilon_q = before + growth / group.scale;
        }
    }
}

std::shared_ptr<const NonlocalSoftening> nonlocal_softening(const Model& model) {
    auto made = std::make_shared<const NonlocalSoftening>(model);
    return made->is_on() ? made : nullptr;
}

}  // namespace breach::fem
