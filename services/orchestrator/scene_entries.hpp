// Lists the entries of a completed scene, each with its unit and whether it has its default value.
// The schema gives their meaning.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace breach::orchestrator {

struct SceneEntry {
    std::string pointer;  ///< "/mpm/floor/level"
    nlohmann::json value;
    std::string unit;  ///< of the schema; empty: it has none
    std::string what;  ///< the schema's description
    bool is_default;   ///< whether the value is the schema's default
};

/// In the order of the document. A list of numbers is one entry; objects in lists have one entry
/// per member. `set`: pointers that an override sets; entries there or below are never defaults.
std::vector<SceneEntry> entries_of(const nlohmann::json& scene,
                                   const std::vector<std::string>& set = {});

}  // namespace breach::orchestrator
