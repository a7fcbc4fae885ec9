// From the scene's words to the loops that do the work: once, before the first step.
#pragma once

#include "mpm_solver/body/body.hpp"

namespace breach::mpm {

/// An elastic solid below this Poisson's ratio does not lock; averaging would only cost it energy.
constexpr double locking_nu = 0.45;

KernelKind kernel_of(scene::Kernel kernel);
Order order_of(const scene::Mpm& mpm);
Choice choice_of(const scene::Mpm& mpm, const Zone& zone);
Loops choose_loops(const Choice& choice, InstructionSet instructions);

/// The zone's law as bare numbers; elastic zones have no strength and do not look at it.
materials::MohrCoulombNumbers numbers_of(const Zone& zone);

}  // namespace breach::mpm
