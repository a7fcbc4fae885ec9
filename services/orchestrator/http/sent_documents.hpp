// Studies and scenes that come over the network, read with what only the door knows: the sender
// may have taken the one for the other, and files are on this machine, not on the sender's.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// folder: its `files` hold what references name. Throws BadInput: one fault when it is a scene, else those of read_study.
Study sent_study(const std::string& body, const std::filesystem::path& folder);
Study sent_study(nlohmann::json document, const std::filesystem::path& folder);

/// The scene, completed. Throws BadInput: one fault when it is a study, else those of
/// read_whole_scene.
nlohmann::json sent_scene(const std::string& body, const std::filesystem::path& folder);

/// The faults with the remedy for a missing file that fits a sender who may sit elsewhere.
std::vector<fault::Fault> seen_from_here(std::vector<fault::Fault> faults);

}  // namespace breach::orchestrator
