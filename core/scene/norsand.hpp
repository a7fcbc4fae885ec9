// NorSand in documents: the only place that knows its keys, their units and their contradictions.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/materials/norsand/law.hpp"

namespace breach::scene {

/// Parameters of a law entry that its schema found sound and `check_norsand` has passed. S is left
/// 0: it belongs to a stage.
materials::norsand::Parameters norsand_parameters(const nlohmann::json& law);

materials::norsand::Options norsand_options(const nlohmann::json& law);

/// Initial state of a point, from an entry or from the law that it falls back on.
struct NorSandStart {
    std::optional<double> psi_0;  ///< state parameter [-]; one of the two
    std::optional<double> e_0;    ///< void ratio [-]
    double R;                     ///< overconsolidation [-]
};
NorSandStart norsand_start(const nlohmann::json& entry, const nlohmann::json& law);

/// Contradictions in a law entry that its schema accepted, `pointer` before each place. Also checks
/// whether the critical state line can be meant for 1 kPa.
std::vector<fault::Fault> check_norsand(const nlohmann::json& law, const std::string& pointer);

/// The same for a material's law in a scene, with the initial state: psi_0 or e_0, and a K_0 that
/// the law can carry.
std::vector<fault::Fault> check_norsand_in_scene(const nlohmann::json& law,
                                                 const std::string& pointer);

/// A material's law that `check_norsand_in_scene` has passed.
materials::NorSand norsand_law(const nlohmann::json& law);

}  // namespace breach::scene
