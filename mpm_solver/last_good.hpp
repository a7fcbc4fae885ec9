// The state at the last check without a fault, for the diagnosis of a breakdown. In single
// precision and without constants: only for display.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class LastGood {
  public:
    LastGood(const Points& points, double time, std::int64_t step) { keep(points, time, step); }

    void keep(const Points& points, double time, std::int64_t step);
    /// The points at that time; `now` are the same ones, later.
    Points restored(const Points& now) const;
    double time() const { return time_; }
    std::int64_t step() const { return step_; }

  private:
    double time_ = 0.0;
    std::int64_t step_ = 0;
    std::vector<float> values_;  ///< array after array, each in the order of the input
};

}  // namespace breach::mpm
