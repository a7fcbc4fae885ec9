// From the scene's words to the loops that do the work: once, before the first step.
#pragma once

#include "core/scene/scene.hpp"
#include "mpm_solver/loops/loops.hpp"

namespace breach::mpm {

/// An elastic solid below this Poisson's ratio does not lock; averaging would only cost it energy.
constexpr double locking_nu = 0.45;

/// Which build of the inner loops runs: every one gives the same answers up to round-off.
enum class InstructionSet { plain, avx2, avx512 };

/// The widest that this CPU has.
InstructionSet best_instruction_set();

KernelKind kernel_of(scene::Kernel kernel);
Order order_of(const scene::Mpm& mpm);
/// Plastic flow keeps its volume and locks, as nearly incompressible elasticity does.
Averages averages_of(const scene::Mpm& mpm, const materials::Law& law);
VolumeRule volume_rule_of(const scene::Mpm& mpm, const materials::Law& law);
/// `law` as its zone has it.
Choice choice_of(const scene::Mpm& mpm, const materials::Law& law, double viscosity);
Loops choose_loops(const Choice& choice, InstructionSet instructions);

}  // namespace breach::mpm
