#include "fem_solver/model/nonlocal.hpp"

#include <algorithm>
#include <numeric>

#include "core/materials/nonlocal.hpp"

namespace breach::fem {

namespace {

/// Drawn positions of a zone's integration points [m].
std::vector<Vec2> positions_of(const Model& model, const Zone& zone) {
    std::vector<Vec2> positions;
    for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
        const Corners corners = corners_of(model.mesh, e);
        for (std::size_t g = 0; g < model.points_per_element; ++g) {
            const Vec2 at = model.points_per_element == 1 ? Vec2::Zero() : gauss_positions()[g];
            positions.emplace_back(corners * shape_functions(at));
        }
    }
    return positions;
}

}  // namespace

NonlocalSoftening::Group NonlocalSoftening::group_of(const Model& model, const Zone& zone) {
    Group group{.first = zone.first * model.points_per_element,
                .count = zone.count * model.points_per_element,
                .spent = materials::spent_strain(*materials::softening(zone.law)),
                .scale = zone.softening_scale,
                .volume = {},
                .rows = {0},
                .neighbours = {},
                .weights = {}};
    for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
        for (std::size_t g = 0; g < model.points_per_element; ++g)
            group.volume.push_back(model.reference[e].weight[g]);
    }
    const std::vector<Vec2> at = positions_of(model, zone);
    // In order of x, so that neighbours lie in one range.
    std::vector<std::int32_t> sorted(at.size());
    std::iota(sorted.begin(), sorted.end(), 0);
    const auto x_of = [&](std::int32_t i) { return at[static_cast<std::size_t>(i)].x(); };
    std::ranges::stable_sort(sorted, {}, x_of);
    const double reach = materials::nonlocal_reach * zone.nonlocal_length;
    for (const Vec2& here : at) {
        const auto begin = std::ranges::lower_bound(sorted, here.x() - reach, {}, x_of);
        for (auto other = begin; other != sorted.end() && x_of(*other) <= here.x() + reach;
             ++other) {
            const double distance = (at[static_cast<std::size_t>(*other)] - here).norm();
            if (distance == 0.0 || distance >= reach) continue;
            group.neighbours.push_back(*other);
            group.weights.push_back(
                static_cast<float>(materials::nonlocal_weight(distance, zone.nonlocal_length)));
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
    for (const Group& group : groups_) {
        std::vector<double> growth(group.count), V(group.count), V_dk(group.count);
        for (std::size_t i = 0; i < group.count; ++i) {
            const std::size_t p = group.first + i;
            growth[i] = trial.points[p].epsilon_q - old.points[p].epsilon_q;
            const bool takes_part = old.points[p].epsilon_q < group.spent &&
                                    !model.is_absent(p / model.points_per_element);
            V[i] = takes_part ? group.volume[i] : 0.0;
            V_dk[i] = V[i] * growth[i];
        }
        if (std::ranges::all_of(growth, [](double each) { return each == 0.0; })) continue;
        for (std::size_t i = 0; i < group.count; ++i) {
            double around = 0.0, given = 0.0;
            for (std::size_t k = group.rows[i]; V[i] > 0.0 && k < group.rows[i + 1]; ++k) {
                const auto j = static_cast<std::size_t>(group.neighbours[k]);
                around += group.weights[k] * V[j];
                given += group.weights[k] * V_dk[j];
            }
            // A point without others around keeps its own growth.
            const double mean = around > 0.0 ? given / around : growth[i];
            const std::size_t p = group.first + i;
            trial.points[p].epsilon_q = old.points[p].epsilon_q + mean / group.scale;
        }
    }
}

std::shared_ptr<const NonlocalSoftening> nonlocal_softening(const Model& model) {
    auto made = std::make_shared<const NonlocalSoftening>(model);
    return made->is_on() ? made : nullptr;
}

}  // namespace breach::fem
