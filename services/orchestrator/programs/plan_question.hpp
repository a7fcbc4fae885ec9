// Queries the phases for their plans: the features that a scene uses and those it leaves out.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace breach::orchestrator {

/// {"fem_solver": "text", ...} for the phases of the scene. `scene` is valid. Runs the
/// phases with --plan, one after another; `scratch`: folder for the scene's file
/// meanwhile.
nlohmann::json plans_of(const nlohmann::json& scene, const std::filesystem::path& bin,
                        const std::filesystem::path& scratch);

}  // namespace breach::orchestrator
