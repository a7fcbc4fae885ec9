#include "mpm_solver/body/nonlocal.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace breach::mpm {

namespace {

/// The weight falls to 4e-4 of its peak.
constexpr double reach = 3.0;  // lengths
/// Soil that has left its softening this far behind flows; its strains say nothing of a band.
constexpr double spent_after = 5.0;  // strains at residual strength

/// r exp(-(r / l)^2): none at the point itself, most at 0.7 l (Galavi & Schweiger 2010).
double weight(double r, double length) { return r * std::exp(-(r / length) * (r / length)); }

/// Where a point's weights lie.
struct Weights {
    std::int32_t first;
    double at[3][3];
};

template <class Kernel>
Weights weights_of(const Kernel& kernel, const Grid& grid, double x, double y) {
    const Stencil<double> sx = kernel(grid.xi(x), grid.walls_x);
    const Stencil<double> sy = kernel(grid.eta(y), grid.walls_y);
    Weights weights{.first = static_cast<std::int32_t>(sx.first) * grid.rows +
                             static_cast<std::int32_t>(sy.first),
                    .at = {}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) weights.at[i][j] = sx.N[i] * sy.N[j];
    }
    return weights;
}

template <class Visit>
void for_nodes(const Grid& grid, const Weights& weights, const Visit& visit) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) visit(weights.first + i * grid.rows + j, weights.at[i][j]);
    }
}

}  // namespace

NonlocalSoftening::NonlocalSoftening(const Points& points, const std::vector<Zone>& zones,
                                     const Grid& grid, KernelKind kernel, double gimp_half_size,
                                     double widest)
    : neighbours_(zones.size()), kernel_(kernel), gimp_half_size_(gimp_half_size), widest_(widest) {
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const Zone& zone = zones[z];
        if (zone.nonlocal_length == 0.0) continue;
        const auto farthest =
            static_cast<std::int32_t>(std::ceil(reach * zone.nonlocal_length * grid.per_h));
        for (std::int32_t c = -farthest; c <= farthest; ++c) {
            for (std::int32_t r = -farthest; r <= farthest; ++r) {
                const double distance = grid.h * std::hypot(c, r);
                if (distance == 0.0 || distance >= reach * zone.nonlocal_length) continue;
                neighbours_[z].push_back({c, r, weight(distance, zone.nonlocal_length)});
            }
        }
        const std::set<std::int32_t> regions(points.region.begin() + zone.begin,
                                             points.region.begin() + zone.end);
        for (const std::int32_t region : regions) groups_.push_back({z, region});
    }
    if (groups_.empty()) return;
    before_.resize(points.size());
    for (auto* numbers : {&volume_, &growth_, &given_, &mean_}) numbers->resize(grid.nodes());
}

void NonlocalSoftening::remember(const Points& points, const std::vector<Zone>& zones) {
    for (std::size_t z = 0; z < zones.size(); ++z) {
        if (neighbours_[z].empty()) continue;
        std::copy(points.epsilon_q_plastic.begin() + zones[z].begin,
                  points.epsilon_q_plastic.begin() + zones[z].end,
                  before_.begin() + zones[z].begin);
    }
}

bool NonlocalSoftening::takes_part(const Points& points, std::size_t p, const Group& group,
                                   double spent) const {
    return points.region[p] == group.region && before_[p] < spent && points.volume[p] < widest_;
}

bool NonlocalSoftening::grows(const Points& points, const Zone& zone) const {
    return !std::equal(before_.begin() + zone.begin, before_.begin() + zone.end,
                       points.epsilon_q_plastic.begin() + zone.begin);
}

void NonlocalSoftening::spread(Points& points, const std::vector<Zone>& zones, const Grid& grid) {
    switch (kernel_) {
        case KernelKind::gimp:
            return spread_with(GimpKernel(gimp_half_size_), points, zones, grid);
        case KernelKind::b_spline:
            return spread_with(BSplineKernel{}, points, zones, grid);
        case KernelKind::linear:
            return spread_with(LinearKernel{}, points, zones, grid);
    }
}

template <class Kernel>
void NonlocalSoftening::spread_with(const Kernel& kernel, Points& points,
                                    const std::vector<Zone>& zones, const Grid& grid) {
    for (const Group& group : groups_) {
        const Zone& zone = zones[group.zone];
        const double spent = spent_after * materials::softening(zone.law)->epsilon_q_end;
        if (!grows(points, zone)) continue;
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            if (!takes_part(points, p, group, spent)) continue;
            const double V = points.V[p];
            const double V_dk = V * (points.epsilon_q_plastic[p] - before_[p]);
            for_nodes(grid, weights_of(kernel, grid, points.x[p], points.y[p]),
                      [&](std::int32_t node, double N) {
                          volume_[node] += N * V;
                          growth_[node] += N * V_dk;
                      });
        }
        average(grid, neighbours_[group.zone]);
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            if (!takes_part(points, p, group, spent)) continue;
            double dk = 0.0;
            for_nodes(grid, weights_of(kernel, grid, points.x[p], points.y[p]),
                      [&](std::int32_t node, double N) { dk += N * mean_[node]; });
            points.epsilon_q_plastic[p] = before_[p] + std::max(dk, 0.0);
        }
        for (const std::int32_t node : grid.active) {
            volume_[node] = growth_[node] = given_[node] = mean_[node] = 0.0;
        }
    }
}

/// The mean growth of every node's neighbourhood, by volume. Most nodes give nothing in a step, so
/// those that do reach out; only where something arrives is the neighbourhood's volume counted.
void NonlocalSoftening::average(const Grid& grid, const std::vector<Neighbour>& neighbours) {
    const auto for_neighbours = [&](std::int32_t node, const auto& visit) {
        const std::int32_t column = node / grid.rows;
        const std::int32_t row = node % grid.rows;
        for (const Neighbour& each : neighbours) {
            const std::int32_t c = column + each.columns;
            const std::int32_t r = row + each.rows;
            if (c < 0 || c >= grid.columns || r < 0 || r >= grid.rows) continue;
            visit(c * grid.rows + r, each.weight);
        }
    };
    for (const std::int32_t node : grid.active) {
        if (growth_[node] <= 0.0) continue;
        for_neighbours(node, [&](std::int32_t to, double w) {
            if (volume_[to] > 0.0) given_[to] += w * growth_[node];
        });
    }
    for (const std::int32_t node : grid.active) {
        if (volume_[node] <= 0.0 || (given_[node] <= 0.0 && growth_[node] <= 0.0)) continue;
        double around = 0.0;
        for_neighbours(node, [&](std::int32_t from, double w) { around += w * volume_[from]; });
        mean_[node] = around > 0.0 ? given_[node] / around : growth_[node] / volume_[node];
    }
}

}  // namespace breach::mpm
