// Everything that a phase's result depends on: the phase, the version of its numerics, and the part
// of the completed scene that it reads (core/phases/reads.hpp), files by their bytes. Together with
// the SHA-256 of its input file this is the key of the cache. It never includes threads, paths,
// names, titles, program versions.
#pragma once

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// `scene`: completed, all overrides applied. An unreadable file is represented by its name.
/// `numerics`: the version that the phase reports.
Recipe recipe_of(const std::string& phase, const nlohmann::json& scene, std::int64_t numerics);

/// Pointers at which two JSON values differ, depth first in the order of the keys; arrays of
/// different lengths differ as a whole.
std::vector<std::string> differences(const nlohmann::json& a, const nlohmann::json& b);

}  // namespace breach::orchestrator
