// The machine's clock of the day, which may be set while the service runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace breach::orchestrator {

/// Both clocks at one moment. Use one reading per moment: between two readings the clock may be set.
struct ClockReading {
    std::chrono::milliseconds of_day;  ///< since 1970
    std::chrono::milliseconds monotonic;

    static ClockReading now();
};

class ClockOfDay {
  public:
    explicit ClockOfDay(ClockReading now = ClockReading::now())
        : ahead_(now.of_day - now.monotonic), true_since_(now.of_day) {}

    /// [s] since that moment [ms since 1970]. Nothing: the clock was set after it, so that the difference is no duration; or it is
    /// before this object was made, when the clock was not watched.
    std::optional<double> seconds_since(std::int64_t moment,
                                        ClockReading now = ClockReading::now());

  private:
    std::chrono::milliseconds ahead_;  ///< of the monotonic clock
    std::chrono::milliseconds true_since_;
};

}  // namespace breach::orchestrator
