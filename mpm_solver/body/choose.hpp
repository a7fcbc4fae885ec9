// From the scene's words to the loops that do the work: once, before the first step.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// An elastic solid below this Poisson's ratio does not lock; averaging would only cost it energy.
constexpr double locking_nu = 0.45;

KernelKind kernel_of(scene::Kernel kernel);
Order order_of(const scene::Mpm& mpm);
/// Plastic flow keeps its volume and locks, as nearly incompressible elasticity does.
Averages averages_of(const scene::Mpm& mpm, const materials::Law& law);
VolumeRule volume_rule_of(const scene::Mpm& mpm, const materials::Law& law);
Choice choice_of(const scene::Mpm& mpm, const Zone& zone);
Loops choose_loops(const Choice& choice, InstructionSet instructions);

}  // namespace breach::mpm
