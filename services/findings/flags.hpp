// Meaning of a result's flags: whether it can be relied on, and which of its numbers are lower bounds.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::findings {

/// The flags in a result.json; empty without a result.
std::vector<fault::Flag> flags_of(const nlohmann::json& result);

/// "still moving"
std::string worded(std::string code);

/// Codes in words, each once: "still moving, numerical share".
std::string listed(const std::vector<fault::Flag>& flags, fault::Severity severity);

/// Whether this quantity of a runout can only grow while soil moves.
bool grows(std::string_view quantity);

/// Whether the soil of a runout still moved at its end: quantities that grow are lower bounds then.
bool still_moves(const nlohmann::json& at_rest, const nlohmann::json& flags);
bool still_moves(const nlohmann::json& result);

}  // namespace breach::findings
