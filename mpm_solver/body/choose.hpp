// Selects the loops for the scene, before the first step.
// make_body selects the loops of each zone, and --plan prints the reasons of the same decisions, so
// that the plan cannot differ from the run.
#pragma once

#include <string>

#include "core/process/plan.hpp"
#include "core/scene/scene.hpp"
#include "mpm_solver/loops/loops.hpp"

namespace breach::mpm {

/// An elastic solid with a smaller Poisson's ratio does not lock; averaging would only cost energy.
constexpr double locking_nu = 0.45;

/// Compiled version of the inner loops; equal results up to round-off.
enum class InstructionSet { plain, avx2, avx512 };

/// The widest that this CPU supports.
InstructionSet best_instruction_set();

/// How the points of one soil are computed.
struct SoilDecisions {
    process::Decided<Averages> averages;
    process::Decided<VolumeRule> volume_rule;
    process::Decided<Viscosity> viscosity;
};

/// A soil for the loops, with scaled `law`.
/// Only for a call: it refers to the caller's objects.
struct SoilOfZone {
    const std::string& material;
    const materials::Law& law;
    double viscosity;  ///< [Pa s]
};
SoilDecisions decide(const scene::Mpm& mpm, const SoilOfZone& soil);

/// How all points are computed.
struct SchemeDecisions {
    process::Decided<Overlap> overlap;
    process::Decided<scene::Shaking> shaking;
};
SchemeDecisions decide(const scene::Mpm& mpm);

Choice choice_of(const scene::Mpm& mpm, const SoilOfZone& soil);
Loops choose_loops(const Choice& choice, InstructionSet instructions);

}  // namespace breach::mpm
