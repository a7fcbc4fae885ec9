#include "mpm_solver/last_good.hpp"

#include <cstddef>

namespace breach::mpm {

namespace {

/// Calls visit(array) for what changes from step to step and is written.
template <class AnyPoints, class Visit>
void for_each_changing(AnyPoints& points, Visit&& visit) {
    visit(points.x), visit(points.y), visit(points.vx), visit(points.vy);
    visit(points.Lxx), visit(points.Lxy), visit(points.Lyx), visit(points.Lyy);
    visit(points.volume);
    visit(points.sxx), visit(points.syy), visit(points.szz), visit(points.sxy);
    visit(points.epsilon_q), visit(points.epsilon_q_plastic), visit(points.gap);
}

}  // namespace

void LastGood::keep(const Points& points, double time, std::int64_t step) {
    time_ = time;
    step_ = step;
    std::size_t arrays = 0;
    for_each_changing(points, [&](const std::vector<double>&) { ++arrays; });
    values_.resize(arrays * points.size());
    auto to = values_.begin();
    for_each_changing(points, [&](const std::vector<double>& values) {
        for (std::size_t p = 0; p < values.size(); ++p)
            to[points.number[p]] = static_cast<float>(values[p]);
        to += static_cast<std::ptrdiff_t>(values.size());
    });
}

Points LastGood::restored(const Points& now) const {
    Points then = now;
    auto from = values_.begin();
    for_each_changing(then, [&](std::vector<double>& values) {
        for (std::size_t p = 0; p < values.size(); ++p) values[p] = from[now.number[p]];
        from += static_cast<std::ptrdiff_t>(values.size());
    });
    return then;
}

}  // namespace breach::mpm
