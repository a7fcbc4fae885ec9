// How the ground moves where nothing fails: the free-field columns run alone from the beginning of the
// shaking to its end, before the mesh takes its first step. Whoever goes on after the FEM (the
// runout) has it in every snapshot, however the FEM ends.
#pragma once

#include <string>

#include "fem_solver/solve/beginning.hpp"

namespace breach::fem {

struct FreeGround {
    exchange::BaseMotion motion;  ///< of the columns' base
    std::string why_not;          ///< there is none
};

/// Of a model with an absorbing base that is shaken, and columns.
/// `start`: the motion of the whole model as its first dynamic stage begins, with the laws and
/// stresses of that stage. What the mesh presses on the columns then stays as a constant force. The
/// samples reach to the end of the stages or of the earthquake, whichever is later.
FreeGround free_ground(const scene::Scene& scene, const Model& whole, const Motion& start);

}  // namespace breach::fem
