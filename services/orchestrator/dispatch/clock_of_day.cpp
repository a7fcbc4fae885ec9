#include "services/orchestrator/dispatch/clock_of_day.hpp"

namespace breach::orchestrator {

namespace {

constexpr auto least_setting = std::chrono::seconds(1);  // less is a clock that is kept right

}  // namespace

std::optional<double> ClockOfDay::seconds_since(std::int64_t moment) {
    const std::chrono::nanoseconds now_ahead = ahead();
    const std::int64_t now = epoch_ms();
    if (std::chrono::abs(now_ahead - ahead_) > least_setting) {
        ahead_ = now_ahead;
        true_since_ = now;
    }
    if (moment < true_since_ || moment > now) return std::nullopt;
    return 1e-3 * static_cast<double>(now - moment);
}

std::chrono::nanoseconds ClockOfDay::ahead() {
    return std::chrono::system_clock::now().time_since_epoch() -
           std::chrono::steady_clock::now().time_since_epoch();
}

}  // namespace breach::orchestrator
