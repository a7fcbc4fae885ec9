// One explicit time step of the material point method, operation by operation. The loops
// (*_loop.hpp) implement the operations on a point; here they are divided among the threads.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Advances the body by dt [s]. No checks: the caller looks at body.tally. Allocates only where
/// points have to be sorted anew. Points that were moved from outside must be sorted first.
void step(Body& body, double dt);

/// Sorts the points when one has moved too far from its home.
void keep_sorted(Body& body);

/// Mass, affine momentum and (unless USF) internal force of the points onto the nodes.
void particle_to_grid(Body& body, double dt);

/// Newton's second law at the active nodes, then walls, floor and friction.
void update_momentum(Body& body, double dt);

/// Velocity (affine FLIP drawn to affine PIC at the rate beta), its gradient and the position of
/// the points.
void grid_to_particle(Body& body, double dt);

/// MUSL: the new momentum, affine part included, onto the nodes once more; gradient from there.
void map_again(Body& body, double dt);

/// USF: gradient from the momentum before forces, stress from it, then the forces.
void update_stress_first(Body& body, double dt);

/// Strain increment, rotation, law, anti-locking and volume of every zone.
void update_stress(Body& body, double dt);

}  // namespace breach::mpm
