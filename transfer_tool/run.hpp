// The transfer as a phase: its plan, and the conversion of one snapshot to one particle file; and
// the advice as another phase.
// main.cpp hands both phases to core/process.
#pragma once

#include "core/process/phase.hpp"

namespace breach::transfer {

/// Raise it when results change for the same input: the cache then reuses no older result.
inline constexpr int numerics = 14;

process::Plan plan(const scene::Scene& scene);
process::Outcome run(process::Session& session);
/// Reads the scene and checks its window.
/// A condition that cannot be parsed is a fault before the run, not when advice is asked for.
scene::Scene read(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// `transfer_tool advise`: telemetry in, result.json out.
process::Phase advise_phase();

}  // namespace breach::transfer
