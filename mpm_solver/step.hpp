// One explicit time step of the material point method, operation by operation, with the points
// distributed among the threads. *_loop.hpp implement the operations on a point.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// Advances the body by dt [s]. The caller checks body.tally. Allocates only to sort points. Sort
/// points that were moved from outside first.
void step(Body& body, double dt);

/// Sorts the points if one has moved too far from its home.
void keep_sorted(Body& body);

/// Maps mass, affine momentum and internal force of the points to the nodes.
void particle_to_grid(Body& body, double dt);

/// Newton's second law at the active nodes, then walls, floor and friction.
void update_momentum(Body& body, double dt);

/// Updates velocity (affine FLIP relaxed to affine PIC at the rate beta), its gradient and the
/// position of the points.
void grid_to_particle(Body& body, double dt);

/// Strain increment, rotation, law, anti-locking and volume of every zone.
void update_stress(Body& body, double dt);

}  // namespace breach::mpm
