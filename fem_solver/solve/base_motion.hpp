// Motion of the ground away from the failure: the free-field columns run alone through the whole
// shaking before the first dynamic step of the mesh. Every snapshot contains it, for the runout,
// even if the FEM ends early.
#pragma once

#include <string>

#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

struct FreeGround {
    exchange::BaseMotion motion;  ///< of the columns' base
    std::string why_not;          ///< why there is no motion
};

/// For a shaken model with absorbing base and columns. `start`: motion of the whole model at the
/// beginning of its first dynamic stage, with that stage's laws and stresses. The force of the mesh
/// on the columns stays constant. Samples reach the end of the stages or of the earthquake,
/// whichever is later.
FreeGround free_ground(const scene::Scene& scene, const Model& whole, const Motion& start);

}  // namespace breach::fem
