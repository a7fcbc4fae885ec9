// State at the last check without a fault, to diagnose a breakdown. In single precision and without
// constants: for display only.
// Simulation::look keeps it after its checks; run.cpp writes it when a run breaks down.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class LastGood {
  public:
    LastGood(const Points& points, double time, std::int64_t step) { keep(points, time, step); }

    void keep(const Points& points, double time, std::int64_t step);
    /// The points at that time; `now`: the same points later.
    Points restored(const Points& now) const;
    double time() const { return time_; }
    std::int64_t step() const { return step_; }

  private:
    double time_ = 0.0;
    std::int64_t step_ = 0;
    std::vector<float> values_;  ///< array by array, in the order of the input
};

}  // namespace breach::mpm
