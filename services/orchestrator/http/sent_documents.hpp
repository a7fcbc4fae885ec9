// Studies and scenes that come over the network, read with what only the HTTP layer knows: the sender
// may have taken the one for the other, and files are on this machine, not on the sender's.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/http/service.hpp"
#include "services/orchestrator/study/read_study.hpp"

namespace breach::orchestrator {

/// Which files its scenes may name.
SentFiles files_of(const Service& service);

/// By its format; without one, by its parts.
bool is_study_document(const nlohmann::json& document);

/// Throws BadInput: one fault when it is a scene, else those of read_study.
Study sent_study(const std::string& body, const Service& service);
Study sent_study(nlohmann::json document, const Service& service);

/// Throws BadInput: one fault when it is a study, else those of
/// read_whole_scene.
WholeScene sent_scene(const std::string& body, const Service& service);

/// The faults with the remedy for a missing file that fits a sender who may sit elsewhere.
std::vector<fault::Fault> seen_from_here(std::vector<fault::Fault> faults);

}  // namespace breach::orchestrator
