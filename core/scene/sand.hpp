// PM4Sand as documents write it: one place knows its keys, their units and what follows from D_R.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/materials/pm4sand/pm4sand.hpp"

namespace breach::scene {

/// Parameters of a law entry that its schema found sound.
materials::pm4sand::Parameters sand_parameters(const nlohmann::json& law);

/// How the law is integrated: keys "compat" and "tolerance".
materials::pm4sand::Options sand_options(const nlohmann::json& law);

/// The parameters with the document's keys and units.
nlohmann::json sand_as_json(const materials::pm4sand::Parameters& parameters);

/// Writes what follows from D_R into a PM4Sand entry; leaves other laws alone.
void complete_sand(nlohmann::json& law);

}  // namespace breach::scene
