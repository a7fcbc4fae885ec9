// A scene that came over the network, checked: what it could read, and everything that is wrong.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/check/check.hpp"
#include "core/check/recordings.hpp"

namespace breach::orchestrator {

/// Which files a scene that was sent may name.
struct SentFiles {
    /// Its `files` hold what references name (core/scene/file_paths.hpp).
    std::filesystem::path folder = "/";
    /// Others must lie in one of these, links followed; nothing: wherever this process can read.
    std::optional<std::vector<std::filesystem::path>> allowed = {};
};

/// check::checked_document, and a fault for each file that is not named by an absolute path (what is sent has no
/// folder) or lies where it may not: it is not opened. Throws BadInput only where it is no object.
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides, const SentFiles& files,
                                check::Recordings& recordings);
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides, const SentFiles& files);

}  // namespace breach::orchestrator
