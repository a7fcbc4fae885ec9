// The lowest value of a function of two or three variables in the unit box, without derivatives.
#pragma once

#include <array>
#include <functional>

#include "core/numerics/simplex.hpp"

namespace breach::lem {

using Corner = numerics::Corner<std::array<double, 3>>;

/// Nelder and Mead from `start` with edges `step`; variables with step 0 stay. Coordinates are
/// kept in [0, 1] by clamping. Started afresh around its own answer, mirrored, until a start gains
/// less than `gain` relative: kinked valleys (a circle that touches a layer) collapse a simplex
/// before its time.
Corner descend(const std::function<double(const std::array<double, 3>&)>& f, const Corner& start,
               const std::array<double, 3>& step, double gain);

}  // namespace breach::lem
