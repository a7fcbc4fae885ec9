#include "core/criteria/criterion.hpp"

namespace breach::criteria {

Criterion::Criterion(Expression condition, double hold)
    : evaluation_(std::move(condition)), hold_(hold) {}

Criterion::State Criterion::take(const Line& line) {
    if (state_ == State::met) return state_;
    if (evaluation_(line.time, line.values) != 1.0) {
        state_ = State::armed;
        crossing_.reset();
        return state_;
    }
    if (!crossing_) crossing_ = line;
    const double slack = 1e-9 * (hold_ + line.time);  // decimal times are not binary ones
    const bool held = line.time - crossing_->time >= hold_ - slack;
    state_ = held ? State::met : State::holding;
    if (held) met_at_ = line.time;
    return state_;
}

}  // namespace breach::criteria
