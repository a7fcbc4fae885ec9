// Motion of the ground away from the failure: the free-field columns run alone from the beginning of
// the shaking to its end, before the mesh takes its first step. Every snapshot contains it, for the
// runout, however the FEM ends.
#pragma once

#include <string>

#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

struct FreeGround {
    exchange::BaseMotion motion;  ///< of the columns' base
    std::string why_not;          ///< why there is none
};

/// For a shaken model with an absorbing base and columns. `start`: the motion of the whole model as
/// its first dynamic stage begins, with the laws and stresses of that stage. The force of the mesh
/// on the columns then stays constant. The samples reach to the end of the stages or of the
/// earthquake, whichever is later.
FreeGround free_ground(const scene::Scene& scene, const Model& whole, const Motion& start);

}  // namespace breach::fem
