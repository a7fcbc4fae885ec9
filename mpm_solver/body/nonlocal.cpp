// One average of a group, on one thread: growth of the points to the nodes, among the nodes, and
// back to the points. Between groups the nodal arrays are zero. follow() is called by
// update_stress.
#include "mpm_solver/body/nonlocal.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/materials/nonlocal.hpp"

namespace breach::mpm {

namespace {

/// Interval between averages. Until then strains soften single points, which must not start bands
/// of their own: with 0.05 a shear layer is 2.6 % narrower, with 0.02 0.4 %.
constexpr double growth_to_share = 0.03;  // of the strain from peak to residual strength

/// Spread of the kernel: mean square of the distance to the nodes, in one direction, over all
/// positions in a cell [cells2].
double spread_of_kernel(double gimp_half_size) {
    return 1.0 / 6.0 + gimp_half_size * gimp_half_size / 3.0;
}

/// Length of the weights at the nodes. Mapping to the nodes and back spreads too, which made bands
/// on coarse cells 10 % too wide.
double among_nodes(double length, double spread) {
    return std::sqrt(length * length - 2.0 * spread);
}

}  // namespace

NonlocalSoftening::Weights NonlocalSoftening::weights_of(const GimpKernel& kernel, const Grid& grid,
                                                         double x, double y) {
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
void NonlocalSoftening::for_nodes(const Grid& grid, const Weights& weights, const Visit& visit) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) visit(weights.first + i * grid.rows + j, weights.at[i][j]);
    }
}

NonlocalSoftening::NonlocalSoftening(const Points& points, const std::vector<Zone>& zones,
                                     const Grid& grid, double gimp_half_size, double widest)
    : neighbourhoods_(zones.size()), gimp_half_size_(gimp_half_size), widest_(widest) {
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const Zone& zone = zones[z];
        if (zone.nonlocal_length == 0.0) continue;
        const double length = grid.h * among_nodes(zone.nonlocal_length * grid.per_h,
                                                   spread_of_kernel(gimp_half_size));
        const auto farthest =
            static_cast<std::int32_t>(std::ceil(materials::nonlocal_reach * length * grid.per_h));
        for (std::int32_t c = -farthest; c <= farthest; ++c) {
            Column column{.columns = c, .rows = 0, .weights = {}};
            for (std::int32_t r = -farthest; r <= farthest; ++r) {
                const double distance = grid.h * std::hypot(c, r);
                if (distance >= materials::nonlocal_reach * length) continue;
                if (column.weights.empty()) column.rows = r;
                column.weights.push_back(materials::nonlocal_weight(distance, length));
            }
            if (!column.weights.empty()) neighbourhoods_[z].push_back(std::move(column));
        }
        const std::set<std::int32_t> regions(points.region.begin() + zone.begin,
                                             points.region.begin() + zone.end);
        for (const std::int32_t region : regions) groups_.push_back({z, region});
    }
    if (groups_.empty()) return;
    for (auto* numbers : {&volume_, &growth_, &given_, &mean_}) numbers->resize(grid.nodes());
}

void NonlocalSoftening::remember(Points& points) {
    points.epsilon_q_shared = points.epsilon_q_plastic;
}

void NonlocalSoftening::follow(Points& points, const std::vector<Zone>& zones, const Grid& grid) {
    if (++pace_.done < pace_.due) return;
    const double growth = spread(points, zones, grid);
    remember(points);
    // Proportional to the last growth, and at most doubled: a slope at rest that starts to slide is
    // seen after few steps.
    const double longer = growth > 0.0 ? std::min(growth_to_share / growth, 2.0) : 2.0;
    const auto due = static_cast<std::int64_t>(longer * static_cast<double>(pace_.due));
    pace_ = {.due = std::clamp(due, std::int64_t{1}, most_steps)};
}

bool NonlocalSoftening::takes_part(const Points& points, std::size_t p, const Group& group,
                                   double spent) const {
    return points.region[p] == group.region && points.epsilon_q_shared[p] < spent &&
           points.volume[p] < widest_;
}

bool NonlocalSoftening::grows(const Points& points, const Zone& zone) {
    const auto& shared = points.epsilon_q_shared;
    return !std::equal(shared.begin() + zone.begin, shared.begin() + zone.end,
                       points.epsilon_q_plastic.begin() + zone.begin);
}

double NonlocalSoftening::spread(Points& points, const std::vector<Zone>& zones, const Grid& grid) {
    const GimpKernel kernel(gimp_half_size_);
    double grown = 0.0;    // volume x growth, over the softening strain
    double squares = 0.0;  // volume x growth^2
    for (const Group& group : groups_) {
        const Zone& zone = zones[group.zone];
        const materials::Softening& softening = *materials::softening(zone.law);
        const double spent = materials::spent_strain(softening);
        const double per_range = 1.0 / (softening.epsilon_q_end - softening.epsilon_q_start);
        // Soil that has not yielded since the last average is equal to the last bit, and most soil
        // has not.
        if (!grows(points, zone)) continue;
        weights_.clear();
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            if (!takes_part(points, p, group, spent)) continue;
            const double V = points.V[p];
            const double growth = points.epsilon_q_plastic[p] - points.epsilon_q_shared[p];
            const double V_dk = V * growth;
            const double part = growth * per_range;
            grown += V * part;
            squares += V * part * part;
            weights_.push_back(weights_of(kernel, grid, points.x[p], points.y[p]));
            for_nodes(grid, weights_.back(), [&](std::int32_t node, double N) {
                volume_[node] += N * V;
                growth_[node] += N * V_dk;
            });
        }
        average(grid, neighbourhoods_[group.zone]);
        // The same points in the same order as above: takes_part reads nothing that this loop
        // changes.
        auto weights = weights_.begin();
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            if (!takes_part(points, p, group, spent)) continue;
            double dk = 0.0;
            for_nodes(grid, *weights++,
                      [&](std::int32_t node, double N) { dk += N * mean_[node]; });
            points.epsilon_q_plastic[p] = points.epsilon_q_shared[p] + std::max(dk, 0.0);
        }
        for (const std::int32_t node : grid.active) {
            volume_[node] = growth_[node] = mean_[node] = 0.0;
        }
        forget_given(grid, neighbourhoods_[group.zone]);
    }
    return grown > 0.0 ? squares / grown : 0.0;
}

/// Resets the columns that the group's points reach, not the whole grid.
void NonlocalSoftening::forget_given(const Grid& grid, const std::vector<Column>& neighbourhood) {
    if (weights_.empty()) return;
    const auto [least, most] = std::ranges::minmax(weights_, {}, &Weights::first);
    const std::int32_t farthest = neighbourhood.back().columns;
    const std::int32_t begin = std::max(least.first / grid.rows - farthest, 0);
    const std::int32_t end = std::min(most.first / grid.rows + 3 + farthest, grid.columns);
    std::fill(given_.begin() + begin * grid.rows, given_.begin() + end * grid.rows, 0.0);
}

/// Volume-weighted mean increment of every node's neighbourhood. Most nodes have none in a step:
/// those that do add to their neighbours, and only where something arrives is the neighbourhood's
/// volume summed.
void NonlocalSoftening::average(const Grid& grid, const std::vector<Column>& neighbourhood) {
    for (const std::int32_t node : grid.active) {
        if (growth_[node] > 0.0) give(grid, node, neighbourhood);
    }
    Run run{0, 0};
    for (const std::int32_t node : grid.active) {
        if (volume_[node] <= 0.0 || (given_[node] <= 0.0 && growth_[node] <= 0.0)) continue;
        if (node != run.end || node % grid.rows == 0) {
            take(grid, run, neighbourhood);
            run.begin = node;
        }
        run.end = node + 1;
    }
    take(grid, run, neighbourhood);
}

void NonlocalSoftening::give(const Grid& grid, std::int32_t node,
                             const std::vector<Column>& neighbourhood) {
    const double growth = growth_[node];
    for (const Column& each : neighbourhood) {
        const std::int32_t column = node / grid.rows + each.columns;
        if (column < 0 || column >= grid.columns) continue;
        const std::int32_t first = node % grid.rows + each.rows;
        const std::int32_t begin = std::max(first, 0);
        const std::int32_t end =
            std::min(first + static_cast<std::int32_t>(each.weights.size()), grid.rows);
        double* to = given_.data() + column * grid.rows;
        for (std::int32_t row = begin; row < end; ++row)
            to[row] += each.weights[row - first] * growth;
    }
}

/// Sums in the same order as node by node.
void NonlocalSoftening::take(const Grid& grid, Run run, const std::vector<Column>& neighbourhood) {
    const std::int32_t own = run.begin / grid.rows * grid.rows;  // first node of the column
    for (const Column& each : neighbourhood) {
        const std::int32_t other = own + each.columns * grid.rows;
        if (other < 0 || other >= grid.nodes()) continue;
        const double* from = volume_.data() + other;
        double* to = mean_.data() + own;  // until all are known
        for (std::size_t k = 0; k < each.weights.size(); ++k) {
            const double weight = each.weights[k];
            const std::int32_t shift = each.rows + static_cast<std::int32_t>(k);
            const std::int32_t begin = std::max(run.begin - own, -shift);
            const std::int32_t end = std::min(run.end - own, grid.rows - shift);
            for (std::int32_t row = begin; row < end; ++row) to[row] += weight * from[row + shift];
        }
    }
    for (std::int32_t node = run.begin; node < run.end; ++node) {
        // Weights are 0 at the node itself: without soil around, it keeps its own mean.
        const double around = mean_[node];
        mean_[node] = around > 0.0 ? given_[node] / around : growth_[node] / volume_[node];
    }
}

}  // namespace breach::mpm
