// PM4Sand in JSON documents: keys, units and the entries derived from D_R, defined only here.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::scene {

/// Parameters from a law entry that its schema accepted.
materials::pm4sand::Parameters sand_parameters(const nlohmann::json& law);

/// How the law is integrated: keys "compat" and "tolerance".
materials::pm4sand::Options sand_options(const nlohmann::json& law);

/// The parameters with the document's keys and units.
nlohmann::json sand_as_json(const materials::pm4sand::Parameters& parameters);

/// Fills in the entries of a PM4Sand law that follow from D_R; ignores other laws.
void complete_sand(nlohmann::json& law);

}  // namespace breach::scene
