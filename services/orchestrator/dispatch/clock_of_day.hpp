// The machine's clock of the day, which somebody may set while the service runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace breach::orchestrator {

class ClockOfDay {
  public:
    /// [s] since that moment [ms since 1970]. Nothing: the clock was set after it, so that the difference is no duration.
    std::optional<double> seconds_since(std::int64_t moment);

  private:
    std::chrono::nanoseconds ahead_ = ahead();  ///< of the monotonic clock
    std::int64_t set_at_ = std::numeric_limits<std::int64_t>::min();

    static std::chrono::nanoseconds ahead();
};

}  // namespace breach::orchestrator
