#include "core/criteria/window.hpp"

#include <cmath>

namespace breach::criteria {

std::optional<Pick> pick_named(std::string_view name) {
    if (name == "first") return Pick::first;
    if (name == "midpoint") return Pick::midpoint;
    if (name == "last_before") return Pick::last_before;
    return std::nullopt;
}

Window::Window(Expression lower, Expression upper, double hold)
    : lower_(std::move(lower), hold), upper_(std::move(upper), hold) {}

void Window::take_upper(const Line& line) {
    if (lower_.state() == Criterion::State::met) upper_.take(line);
}

std::optional<double> picked(Pick pick, double lower, double upper, std::span<const double> times) {
    constexpr double slack = 1e-6;  // names of snapshots carry six decimals
    const double half_way = 0.5 * (lower + upper);
    std::optional<double> best;
    for (const double t : times) {
        if (t < lower - slack || t > upper + slack) continue;
        if (pick == Pick::last_before && t > upper - slack) continue;
        const bool better =
            !best || pick == Pick::last_before ||
            (pick == Pick::midpoint && std::abs(t - half_way) < std::abs(*best - half_way) - slack);
        if (better) best = t;
    }
    return best;
}

}  // namespace breach::criteria
