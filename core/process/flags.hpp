// Flags as a result and a checkpoint hold them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::process {

nlohmann::json as_json(const std::vector<fault::Flag>& flags);

/// What as_json made; throws nlohmann's exception where it is something else.
std::vector<fault::Flag> flags_from(const nlohmann::json& list);

}  // namespace breach::process
