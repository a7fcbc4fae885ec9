// The machine's clock of the day, which somebody may set while the service runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

class ClockOfDay {
  public:
    /// [s] since that moment [ms since 1970]. Nothing: the clock was set after it, so that the difference is no duration; or it is
    /// before this object, when nobody watched the clock.
    std::optional<double> seconds_since(std::int64_t moment);

  private:
    std::chrono::nanoseconds ahead_ = ahead();  ///< of the monotonic clock
    std::int64_t true_since_ = epoch_ms();

    static std::chrono::nanoseconds ahead();
};

}  // namespace breach::orchestrator
