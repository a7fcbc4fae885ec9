#include "core/criteria/window.hpp"

#include <cmath>
#include <limits>

#include "core/words/words.hpp"

namespace breach::criteria {

static constexpr auto words_of(Pick) {
    using enum Pick;
    return words::in_order<Pick>(
        {{first, "first"}, {midpoint, "midpoint"}, {last_before, "last_before"}});
}

std::optional<Pick> pick_named(std::string_view name) { return words::find<Pick>(name); }

Window::Window(Expression lower, Expression upper, double hold)
    : lower_(std::move(lower), hold),
      upper_(upper, hold),
      span_(std::move(upper), std::numeric_limits<double>::max()) {}

void Window::take_upper(const Line& line) {
    using State = Criterion::State;
    if (upper_.state() == State::met) return;
    span_.take(line);
    if (lower_.state() != State::met || upper_.take(line) != State::met) return;
    if (span_.crossing()->time <= lower_.crossing()->time) shut_since_ = span_.crossing();
}

void Window::take(const telemetry::Line& line, const std::map<std::string, double>& beside) {
    take_lower(line_for(lower_.expression(), line, beside));
    take_upper(line_for(upper_.expression(), line, beside));
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
