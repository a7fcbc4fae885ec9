// Checks a scene that was uploaded: the readable part, and every fault. For submissions and
// previews, and once more for each variant.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/check/check.hpp"
#include "core/check/recordings.hpp"

namespace breach::orchestrator {

/// The files that an uploaded scene may name.
struct SentFiles {
    /// folder/files contains the targets of references (core/scene/file_paths.hpp).
    std::filesystem::path folder = "/";
    /// Other files must lie in one of these folders, links followed; nothing: any readable file.
    std::optional<std::vector<std::filesystem::path>> allowed = {};
    /// Limit of each file [bytes]: the service reads them into its memory.
    std::uintmax_t largest = std::numeric_limits<std::uintmax_t>::max();
};

/// check::checked_document, plus a fault for each file that is not named by an absolute path (an
/// uploaded scene has no folder), lies outside the allowed folders, or is larger than allowed or no
/// file of a disk (device, pipe, /proc); such files are not opened.
/// Throws BadInput as scene::read_text does.
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides, const SentFiles& files,
                                check::Recordings& recordings);
check::Checked check_sent_scene(const nlohmann::json& document,
                                const std::vector<std::string>& overrides, const SentFiles& files);
/// The same for the scene of a study; the pointers of a thrown BadInput begin with `prefix`.
check::Checked check_scene_of_study(const std::string& prefix, const nlohmann::json& document,
                                    const std::vector<std::string>& overrides,
                                    const SentFiles& files, check::Recordings& recordings);

}  // namespace breach::orchestrator
