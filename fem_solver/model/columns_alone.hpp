// Extracts the free-field columns of a model as a model of their own: level ground without the load of a
// dam and without failure. Their shaking: solve/base_motion.hpp.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Elements, nodes, ties, water and dashpots of the columns behind the body; both columns where there are two, tied at the base
/// as in the whole. `whole` has columns.
Model columns_alone(const Model& whole);

/// The columns' part of a motion of the whole.
Motion columns_alone(const Model& whole, const Motion& motion);

}  // namespace breach::fem
