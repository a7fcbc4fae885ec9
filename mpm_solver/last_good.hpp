// The state at the last look that found all well, for whoever wants to see what led to a breakdown.
// Kept in single precision and without what never changes: it is only looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class LastGood {
  public:
    LastGood(const Points& points, double time, std::int64_t step) { keep(points, time, step); }

    void keep(const Points& points, double time, std::int64_t step);
    /// The points as they were; `now` are the same ones, later.
    Points restored(const Points& now) const;
    double time() const { return time_; }
    std::int64_t step() const { return step_; }

  private:
    double time_ = 0.0;
    std::int64_t step_ = 0;
    std::vector<float> values_;  ///< array after array, each in the order of the input
};

}  // namespace breach::mpm
