// The phase lem_tool: factors of safety of the scene's circle or search, written as result.json and
// as data for figures.
// main.cpp hands plan and run to core/process. The service's triggers compare the depth to which
// the FEM's soil has liquefied with this phase's critical_depth.
#pragma once

#include "core/process/phase.hpp"

namespace breach::lem {

/// Raise it when results change for the same input: the cache then reuses no older result.
inline constexpr int numerics = 9;

process::Plan plan(const scene::Scene& scene);

/// Analyses /lem. result.json: facts of the surface with the least valid factor_of_safety, facts of
/// every other surface under its name (lem_tool/answer.hpp), surfaces_*, seconds. surfaces.h5: the
/// best circle of each pair of ends and the slices of the critical one. Throws BadInput if the
/// given circle cannot be analysed or the search finds no surface.
process::Outcome run(process::Session& session);

}  // namespace breach::lem
