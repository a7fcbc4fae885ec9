// Minimises a function of two or three variables in the unit box, without derivatives.
// The search's variables are shares of its ranges, hence the box. F has kinks and steps to infinity
// (no surface), so that derivatives would be useless.
#pragma once

#include <array>
#include <functional>

#include "core/numerics/simplex.hpp"

namespace breach::lem {

using Corner = numerics::Corner<std::array<double, 3>>;

/// Nelder and Mead from `start` with edges `step`; variables with step 0 are constant. Coordinates
/// are clamped to [0, 1]. Restarts at its result, mirrored, until the relative gain is below
/// `gain`: on functions with kinks (a circle that touches a layer) a simplex collapses too early.
Corner descend(const std::function<double(const std::array<double, 3>&)>& f, const Corner& start,
               const std::array<double, 3>& step, double gain);

}  // namespace breach::lem
