// The free-field columns of a model as a separate model: level ground without the load of a dam and
// without failure. Their shaking: solve/base_motion.hpp.
// Called once, when the first dynamic stage begins (base_motion.cpp).
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Elements, nodes, ties, water and dashpots of the columns; two columns stay tied at the base.
/// `whole` must have columns.
Model columns_alone(const Model& whole);

Motion columns_alone(const Model& whole, const Motion& motion);

}  // namespace breach::fem
