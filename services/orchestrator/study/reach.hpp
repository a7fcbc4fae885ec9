// The phases that a study's tasks include. Decided once, when the study is read (read_study.cpp);
// graph and repeats ask it instead of looking at the scene.
#pragma once

#include <vector>

#include "core/phases/phases.hpp"

namespace breach::orchestrator {

/// FEM, transfer and MPM; the MPM alone, from the section itself; the FEM alone; lem_tool alone.
enum class Reach { chain, filled_mpm, fem, lem };
/// The phases of a variant, first to last.
std::vector<phases::Phase> phases_of(Reach reach);
/// Whether there are material points, whose lattice can be moved.
bool has_lattice(Reach reach);

}  // namespace breach::orchestrator
