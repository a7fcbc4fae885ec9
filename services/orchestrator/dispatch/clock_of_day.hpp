// The wall clock of the machine, which someone may set while the service runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace breach::orchestrator {

/// Both clocks at one moment. Use one reading per moment: the clock may be set between two
/// readings.
struct ClockReading {
    std::chrono::milliseconds of_day;  ///< since 1970
    std::chrono::milliseconds monotonic;

    static ClockReading now();
};

class ClockOfDay {
  public:
    explicit ClockOfDay(ClockReading now = ClockReading::now())
        : ahead_(now.of_day - now.monotonic), true_since_(now.of_day) {}

    /// Seconds since that moment [ms since 1970]. Nothing: the clock was set since then, or the
    /// moment is before this object existed, when the clock was not watched.
    std::optional<double> seconds_since(std::int64_t moment,
                                        ClockReading now = ClockReading::now());

  private:
    std::chrono::milliseconds ahead_;  ///< wall clock minus monotonic clock
    std::chrono::milliseconds true_since_;
};

}  // namespace breach::orchestrator
