// What a phase's result depends on: the phase, the version of its numerics, and the part of the
// completed scene that it reads (core/phases/reads.hpp), files by their bytes. Together with the
// SHA-256 of its input file this is the key of the cache. Never in it: threads, paths, names, titles,
// program versions.
#pragma once

#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// `scene`: completed, all overrides applied. A file that cannot be read stands for its name.
/// `numerics`: what the phase says of itself.
Recipe recipe_of(const std::string& phase, const nlohmann::json& scene, std::int64_t numerics);

/// Pointers at which two JSON values differ, deepest first found in order of the keys: an array of
/// another length differs as a whole.
std::vector<std::string> differences(const nlohmann::json& a, const nlohmann::json& b);

}  // namespace breach::orchestrator
