#include "mpm_solver/sort.hpp"

#include <algorithm>

namespace breach::mpm {

namespace {

template <class Value>
void permute(std::vector<Value>& values, const std::vector<std::int32_t>& order,
             std::vector<Value>& scratch) {
    for (std::size_t p = 0; p < order.size(); ++p) scratch[p] = values[order[p]];
    values.swap(scratch);
}

}  // namespace

Sorter::Sorter(const Body& body)
    : starts_(body.grid.nodes() + 1),
      order_(body.points.size()),
      reals_(body.points.size()),
      integers_(body.points.size()) {}

void Sorter::sort(Body& body) {
    Points& points = body.points;
    const Grid& grid = body.grid;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.cell[p] = grid.cell(grid.xi(points.x[p]), grid.eta(points.y[p]));
    }
    for (const Zone& zone : body.zones) {
        std::fill(starts_.begin(), starts_.end(), 0);
        for (std::size_t p = zone.begin; p < zone.end; ++p) ++starts_[points.cell[p] + 1];
        for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            order_[zone.begin + starts_[points.cell[p]]++] = static_cast<std::int32_t>(p);
        }
    }
    for_each_real(points, [&](const char*, auto& values) { permute(values, order_, reals_); });
    for_each_integer(points,
                     [&](const char*, auto& values) { permute(values, order_, integers_); });
}

}  // namespace breach::mpm
