// Layers that liquefy from the top down: one search per stage.
// The trigger's depth comes from here: critical_depth is what the FEM's liquefaction has to reach
// (docs/reference/methods/lem.md, *Liquefied stages*).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lem_tool/bounds.hpp"

namespace breach::lem {

/// Adds stages, critical_depth, depth_at_fs_1 and surfaces_analysed_in_stages to the result, and
/// the flags of the liquefied states. `unliquefied`: result of the first stage.
void add_stages(const scene::Scene& scene, const Model& sound, const Families& unliquefied,
                int threads, nlohmann::json& result, std::vector<fault::Flag>& flags);

/// Flags about the critical depth: the slope fails without liquefaction, or stands with all layers
/// liquefied.
std::vector<fault::Flag> flags_of_stages(const nlohmann::json& stages);

std::string table_of(const nlohmann::json& stages);

}  // namespace breach::lem
