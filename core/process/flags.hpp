// Flags as JSON, for results and checkpoints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::process {

nlohmann::json as_json(const std::vector<fault::Flag>& flags);

/// Inverse of as_json; throws nlohmann's exception for any other JSON.
std::vector<fault::Flag> flags_from(const nlohmann::json& list);

}  // namespace breach::process
