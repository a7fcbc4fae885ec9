// Keeps a clock that was set from spoiling the histograms of waiting times: a moment from before
// the jump cannot be compared with one after it, so it gives no sample. The difference between
// the two clocks reveals a jump without a timer.
#include "services/orchestrator/dispatch/clock_of_day.hpp"

namespace breach::orchestrator {

namespace {

using std::chrono::milliseconds;

constexpr auto least_setting = std::chrono::seconds(1);  // smaller steps are normal corrections

template <class Clock>
milliseconds reading_of() {
    return std::chrono::duration_cast<milliseconds>(Clock::now().time_since_epoch());
}

}  // namespace

ClockReading ClockReading::now() {
    return {reading_of<std::chrono::system_clock>(), reading_of<std::chrono::steady_clock>()};
}

std::optional<double> ClockOfDay::seconds_since(std::int64_t moment, ClockReading now) {
    const milliseconds ahead = now.of_day - now.monotonic;
    if (std::chrono::abs(ahead - ahead_) > least_setting) {
        ahead_ = ahead;
        true_since_ = now.of_day;
    }
    const milliseconds since(moment);
    if (since < true_since_ || since > now.of_day) return std::nullopt;
    return std::chrono::duration<double>(now.of_day - since).count();
}

}  // namespace breach::orchestrator
