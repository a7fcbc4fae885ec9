// Asks the phases for their plans: what a scene needs of each and what it leaves out.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace breach::orchestrator {

/// {"fem_solver": "text", ...} for the phases that the scene has a part for. `scene` is sound. The
/// phases run with
/// --plan, one after another; `scratch` takes the scene's file for that time.
nlohmann::json plans_of(const nlohmann::json& scene, const std::filesystem::path& bin,
                        const std::filesystem::path& scratch);

}  // namespace breach::orchestrator
