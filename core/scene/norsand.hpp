// NorSand in JSON documents: keys, units and contradictions, defined only here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/materials/norsand/law.hpp"

namespace breach::scene {

/// Parameters from a law entry that passed the schema and `check_norsand`. S is 0: stages set it.
materials::norsand::Parameters norsand_parameters(const nlohmann::json& law);

materials::norsand::Options norsand_options(const nlohmann::json& law);

/// Initial state of a point, from an entry or, by default, from the law.
struct NorSandStart {
    std::optional<double> psi_0;  ///< state parameter [-]; give one of psi_0 and e_0
    std::optional<double> e_0;    ///< void ratio [-]
    double R;                     ///< overconsolidation ratio [-]
};
NorSandStart norsand_start(const nlohmann::json& entry, const nlohmann::json& law);

/// Contradictions in a law entry that passed the schema; `pointer` is its place. Also reports a
/// critical state line that cannot be meant for 1 kPa.
std::vector<fault::Fault> check_norsand(const nlohmann::json& law, const std::string& pointer);

/// The same for a material's law in a scene, with its initial state: psi_0 or e_0, and a K_0 that
/// the law allows.
std::vector<fault::Fault> check_norsand_in_scene(const nlohmann::json& law,
                                                 const std::string& pointer);

/// A material's law that `check_norsand_in_scene` has passed.
materials::NorSand norsand_law(const nlohmann::json& law);

}  // namespace breach::scene
