// Inside core/scene only: is a number plausible, and which slip of the unit would explain it? Both
// answers stand in the schema, as annotations: an entry's "x-plausible" [from, to], in its own
// unit, and the slips of that unit in the root's "x-slips" (an entry's own "x-slips" count
// instead).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace breach::scene {

/// "19 looks like kN/m3: write 1937 kg/m3" for every slip that brings the value into what is
/// plausible for the entry; empty: no slip does.
std::string likely_slip(double value, const nlohmann::json& entry, const nlohmann::json& root);

/// Why the value is hardly meant, with the likely slip; nothing when it is plausible or the entry
/// does not say what is. Zero says "none" and is always plausible where the limits let it pass.
std::optional<std::string> warning_about(double value, const nlohmann::json& entry,
                                         const nlohmann::json& root);

/// As people write it: six digits at most, no exponent between 1e-4 and 1e9.
std::string plain_number(double value);

}  // namespace breach::scene
