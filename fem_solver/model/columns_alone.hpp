// The free-field columns taken out of a model, as a model that stands by itself: level ground that no dam
// loads and no failure distorts. How it is shaken: solve/base_motion.hpp.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Elements, nodes, ties, water and dashpots of the columns behind the body; both columns where there are two, tied at the base
/// as in the whole. `whole` has columns.
Model columns_alone(const Model& whole);

/// Their share of a motion of the whole.
Motion columns_alone(const Model& whole, const Motion& motion);

}  // namespace breach::fem
