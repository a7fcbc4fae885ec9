// Inside core/scene only: whether a number is plausible, and which wrong unit would explain it.
// From the schema's annotations: an entry's "x-plausible" [from, to] in its own unit, and the
// unit's slips in the root's "x-slips" (an entry's own "x-slips" replace them).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace breach::scene {

/// "19 looks like kN/m3: write 1937 kg/m3" for every slip that makes the value plausible; empty:
/// none.
std::string likely_slip(double value, const nlohmann::json& entry, const nlohmann::json& root);

/// Why the value is implausible, with the likely slip; none if it is plausible or the entry has no
/// "x-plausible". Zero means "none" and is plausible within the limits.
std::optional<std::string> warning_about(double value, const nlohmann::json& entry,
                                         const nlohmann::json& root);

/// Up to six digits, no exponent between 1e-4 and 1e9.
std::string plain_number(double value);

}  // namespace breach::scene
