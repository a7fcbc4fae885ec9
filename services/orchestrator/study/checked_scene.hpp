// A scene that came over the network, checked: what it could read, and everything that is wrong.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/check/check.hpp"
#include "core/check/recordings.hpp"

namespace breach::orchestrator {

/// check::checked_document, and a fault for each file that is not named by an absolute path: what is sent
/// has no folder. Files that were sent (file:sha256/...) are looked for below `folder`. Throws BadInput
/// only where it is no object.
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides,
                                const std::filesystem::path& folder, check::Recordings& recordings);
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides,
                                const std::filesystem::path& folder);

}  // namespace breach::orchestrator
