// A point strays at most half a cell before the next sort, and reaches the 3 x 3 nodes around its
// nearest node: together two columns beyond its home. Strip k thus touches columns 4k - 2 to 4k +
// 5, and strip k + 2 begins at 4k + 6: neighbours of the same colour never meet.
// sort() runs when keep_sorted (step.cpp) finds a point too far from home, cut() alone after a
// checkpoint was loaded.
#include "mpm_solver/body/strips.hpp"

#include <algorithm>
#include <numeric>

namespace breach::mpm {

namespace {

template <class Value>
void permute(std::vector<Value>& values, const std::vector<std::int32_t>& order,
             std::vector<Value>& scratch) {
    scratch.resize(values.size());
    for (std::size_t p = 0; p < order.size(); ++p) scratch[p] = values[order[p]];
    values.swap(scratch);
}

/// Stable counting sort by home, so the order depends on the points alone. `starts`: scratch.
void order_zone(const Grid& grid, const Points& points, const Zone& zone,
                std::vector<std::int32_t>& starts, std::vector<std::int32_t>& order) {
    starts.assign(static_cast<std::size_t>(grid.nodes()) + 1, 0);
    for (std::size_t p = zone.begin; p < zone.end; ++p) ++starts[points.home[p] + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        order[zone.begin + starts[points.home[p]]++] = static_cast<std::int32_t>(p);
    }
}

void mark_reachable(const Grid& grid, const Points& points, const Zone& zone,
                    std::vector<std::uint8_t>& marked) {
    std::int32_t last = -1;
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        const std::int32_t home = points.home[p];
        // Sorted points with the same home follow one another.
        if (home == last) continue;
        last = home;
        const std::int32_t i = home / grid.rows;
        const std::int32_t j = home % grid.rows;
        for (std::int32_t k = std::max(i - 2, 0); k <= std::min(i + 2, grid.columns - 1); ++k) {
            const auto column = marked.begin() + k * grid.rows;
            std::fill(column + std::max(j - 2, 0), column + std::min(j + 3, grid.rows),
                      std::uint8_t{1});
        }
    }
}

/// Indices of the marked nodes, ascending; without spare capacity.
std::vector<std::int32_t> marked(const std::vector<std::uint8_t>& nodes) {
    std::vector<std::int32_t> found;
    found.reserve(static_cast<std::size_t>(std::ranges::count(nodes, 1)));
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        if (nodes[node]) found.push_back(static_cast<std::int32_t>(node));
    }
    return found;
}

}  // namespace

void Strips::sort(Grid& grid, Points& points, const std::vector<Zone>& zones) {
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.home[p] = grid.nearest_node(grid.xi(points.x[p]), grid.eta(points.y[p]));
    }
    // Local scratch memory: sorts are rare.
    std::vector<std::int32_t> starts;
    std::vector<std::int32_t> order(points.size());
    for (const Zone& zone : zones) order_zone(grid, points, zone, starts, order);
    if (!std::is_sorted(order.begin(), order.end())) {
        std::vector<double> reals;
        for_each_real(points, [&](const char*, auto& values) { permute(values, order, reals); });
        std::vector<std::int32_t> integers;
        for_each_integer(points,
                         [&](const char*, auto& values) { permute(values, order, integers); });
    }
    cut(grid, points, zones);
}

void Strips::cut(Grid& grid, const Points& points, const std::vector<Zone>& zones) {
    zones_ = zones.size();
    count_ = static_cast<std::size_t>((grid.columns + width - 1) / width);
    spans_.assign(count_ * zones_, {0, 0});
    std::vector<std::uint8_t> holds_points(count_, 0);
    for (std::size_t z = 0; z < zones_; ++z) {
        std::size_t p = zones[z].begin;
        while (p < zones[z].end) {
            // By home, not by position: until the next sort a point belongs to the strip that it
            // was sorted into.
            const std::int32_t strip = points.home[p] / grid.rows / width;
            const std::size_t begin = p;
            while (p < zones[z].end && points.home[p] / grid.rows / width == strip) ++p;
            spans_[strip * zones_ + z] = {begin, p};
            holds_points[strip] = 1;
        }
    }
    all_.clear();
    for (std::size_t colour = 0; colour < apart_.size(); ++colour) {
        apart_[colour].clear();
        for (std::size_t strip = colour; strip < count_; strip += apart_.size()) {
            if (holds_points[strip]) apart_[colour].push_back(strip);
        }
        all_.insert(all_.end(), apart_[colour].begin(), apart_[colour].end());
    }
    // From left to right: for_all_points adds the strips' sums in this order.
    std::sort(all_.begin(), all_.end());
    find_active_nodes(grid, points, zones);
}

/// The 5 x 5 nodes around every home: those that a point can reach.
void Strips::find_active_nodes(Grid& grid, const Points& points, const std::vector<Zone>& zones) {
    // While the old list is known: step() clears only active nodes, and a node that leaves the list
    // would keep its last values.
    clear(grid);
    std::vector<std::uint8_t> of_any(static_cast<std::size_t>(grid.nodes()), 0);
    std::vector<std::uint8_t> of_zone;
    cells_.clear();
    for (const Zone& zone : zones) {
        of_zone.assign(of_any.size(), 0);
        mark_reachable(grid, points, zone, of_zone);
        cells_.push_back(marked(of_zone));
        for (const std::int32_t node : cells_.back()) of_any[node] = 1;
    }
    grid.active = marked(of_any);
}

}  // namespace breach::mpm
