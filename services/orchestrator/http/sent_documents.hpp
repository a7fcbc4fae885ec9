// Studies and scenes that come over the network, read with what only the door knows: the sender
// may have taken the one for the other, and files are on this machine, not on the sender's.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/study/study.hpp"
#include "services/report/section/section_drawing.hpp"

namespace breach::orchestrator {

/// Throws BadInput: one fault when it is a scene, else those of read_study.
Study sent_study(const std::string& body);

/// The scene, completed. Throws BadInput: one fault when it is a study, else those of
/// read_whole_scene.
nlohmann::json sent_scene(const std::string& body);

/// A scene, or the base scene of a study, with all that is wrong with it. Throws BadInput only where
/// there is no scene in it.
report::Draft sent_draft(const nlohmann::json& document);

}  // namespace breach::orchestrator
