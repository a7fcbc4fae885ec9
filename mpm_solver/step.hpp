// One explicit time step of the material point method, verb by verb.
#pragma once

#include "mpm_solver/body.hpp"

namespace breach::mpm {

/// Advances the body by dt [s]. No allocation, no checks: the caller looks at body.tally.
void step(Body& body, double dt);

/// Chooses the verbs that the scene's options ask for.
Verbs choose_verbs(const scene::Mpm& mpm);

/// Mass, affine momentum and internal force of the points onto the nodes.
template <class Kernel>
void particle_to_grid(Body& body);

/// Newton's second law at the active nodes, then walls, floor and friction.
void update_momentum(Body& body, double dt);

/// Velocity (affine FLIP drawn to affine PIC at the rate beta), its gradient and the position of
/// the points.
template <class Kernel, scene::UpdateOrder order, scene::AntiLocking anti_locking>
void grid_to_particle(Body& body, double dt);

/// MUSL: the new momentum, affine part included, onto the nodes once more; gradient from there.
template <class Kernel, scene::AntiLocking anti_locking>
void map_again(Body& body, double dt);

/// Is the points' `excess` overlap pushed apart?
enum class Overlap { left_alone, corrected };

/// Strain increment, rotation, law, anti-locking and volume of every zone.
template <scene::AntiLocking anti_locking, Overlap overlap>
void update_stress(Body& body, double dt);

}  // namespace breach::mpm
