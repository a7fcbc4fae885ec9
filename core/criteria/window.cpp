#include "core/criteria/window.hpp"

#include <cmath>

#include "core/words/words.hpp"

namespace breach::criteria {

static constexpr auto words_of(Pick) {
    using enum Pick;
    return words::in_order<Pick>(
        {{first, "first"}, {midpoint, "midpoint"}, {last_before, "last_before"}});
}

constexpr double slack = 1e-6;  // names of snapshots have six decimals [s]

std::optional<Pick> pick_named(std::string_view name) { return words::find<Pick>(name); }

Window::Window(Expression lower, Expression upper, double hold)
    : lower_(std::move(lower), hold), upper_(std::move(upper), hold) {}

/// An interval found during the lower condition's hold is dropped if that condition becomes false.
void Window::take_upper(const Line& line) {
    using State = Criterion::State;
    last_time_ = line.time;
    if (lower_.state() == State::met && began_) return;
    const bool held = upper_.follow(line) == State::met;
    if (lower_.state() == State::armed)
        began_.reset();
    else if (held && !began_)
        began_ = upper_.crossing();
}

std::optional<Line> Window::upper_edge() const {
    const bool known = lower_.state() == Criterion::State::met && began_;
    return known && began_->time > lower_.crossing()->time ? began_ : std::nullopt;
}

std::optional<Line> Window::shut_since() const {
    const bool known = lower_.state() == Criterion::State::met && began_;
    return known && began_->time <= lower_.crossing()->time ? began_ : std::nullopt;
}

bool Window::is_open_at(double t) const {
    const std::optional<Line>& running = began_ ? began_ : upper_.crossing();
    return running ? t < running->time - slack : t <= last_time_ + slack;
}

void Window::take(const telemetry::Line& line, const std::map<std::string, double>& beside) {
    take_lower(line_for(lower_.expression(), line, beside));
    take_upper(line_for(upper_.expression(), line, beside));
}

std::optional<double> picked(Pick pick, double lower, double upper, std::span<const double> times) {
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
