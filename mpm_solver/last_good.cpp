#include "mpm_solver/last_good.hpp"

#include <cstddef>

namespace breach::mpm {

namespace {

/// Calls visit(array) for what changes during steps and is written.
template <class AnyPoints, class Visit>
void for_each_changing(AnyPoints& points, Visit&& visit) {
    for (const auto& real : reals_of_points<Reals>)
        if (real.life == Life::output) visit(points.*real.array);
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
            // In the input's order: the points may be sorted before the state is restored.
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
