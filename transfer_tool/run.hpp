// The transfer as a phase: its plan, and one snapshot in, one particle file out; and its advice as
// another.
#pragma once

#include "core/process/phase.hpp"

namespace breach::transfer {

/// Raised when the numbers change for the same input: the cache takes no result of another one.
inline constexpr int numerics = 11;

process::Plan plan(const scene::Scene& scene);
process::Outcome run(process::Session& session);
/// The scene, and whether its advice window can be read.
scene::Scene read(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// `transfer_tool advise`: telemetry in, result.json out.
process::Phase advise_phase();

}  // namespace breach::transfer
