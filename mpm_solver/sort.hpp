// Puts points that share nodes next to each other in memory.
#pragma once

#include "mpm_solver/body.hpp"

namespace breach::mpm {

/// Above this many points the arrays no longer fit the cache and sorting pays; below it is left
/// out.
constexpr std::size_t least_points_to_sort = 40000;
constexpr std::int64_t steps_between_sorts = 50;

class Sorter {
  public:
    explicit Sorter(const Body& body);
    /// Counting sort of every zone by cell; stable, so the order depends on the points alone.
    void sort(Body& body);

  private:
    std::vector<std::int32_t> starts_;
    std::vector<std::int32_t> order_;
    std::vector<double> reals_;
    std::vector<std::int32_t> integers_;
};

}  // namespace breach::mpm
