#include "core/criteria/criterion.hpp"

#include <limits>

namespace breach::criteria {

Line line_for(const Expression& expression, const telemetry::Line& line,
              const std::map<std::string, double>& beside) {
    Line wanted{line.time, line.step, {}};
    for (const std::string& field : expression.fields) {
        const auto fixed = beside.find(field);
        const auto own = line.values.find(field);
        wanted.values.push_back(fixed != beside.end() ? fixed->second
                                : own != line.values.end()
                                    ? own->second
                                    : std::numeric_limits<double>::quiet_NaN());
    }
    return wanted;
}

Criterion::Criterion(Expression condition, double hold)
    : evaluation_(std::move(condition)), hold_(hold) {}

Criterion::State Criterion::take(const Line& line) {
    return state_ == State::met ? state_ : follow(line);
}

Criterion::State Criterion::follow(const Line& line) {
    if (evaluation_(line.time, line.values) != 1.0) {
        state_ = State::armed;
        crossing_.reset();
        return state_;
    }
    if (!crossing_) crossing_ = line;
    const double slack = 1e-9 * (hold_ + line.time);  // times in decimals are not exact in binary
    const bool held = line.time - crossing_->time >= hold_ - slack;
    if (held && state_ != State::met) met_at_ = line.time;
    state_ = held ? State::met : State::holding;
    return state_;
}

}  // namespace breach::criteria
