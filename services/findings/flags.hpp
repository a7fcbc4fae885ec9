// Interprets a result's flags: its reliability, and which numbers are lower bounds.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::findings {

/// "still moving"
std::string worded(std::string code);

/// Whether this quantity of a runout can only grow while soil moves.
bool grows(std::string_view quantity);

/// Whether soil still moved at the end, so that growing quantities are lower bounds. Views mark
/// these with "at least"; they never leave them out.
bool still_moves(const nlohmann::json& at_rest, const nlohmann::json& flags);
bool still_moves(const nlohmann::json& result);

}  // namespace breach::findings
