// Reads uploaded studies and scenes, with checks for the HTTP layer: the sender may have confused
// the two, and files are on this machine, not on the sender's.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "services/orchestrator/http/service.hpp"
#include "services/orchestrator/study/read_study.hpp"

namespace breach::orchestrator {

/// The files that its scenes may name.
SentFiles files_of(const Service& service);

/// By its format; without one, by its entries.
bool is_study_document(const nlohmann::json& document);

/// Throws BadInput: one fault when it is a scene, else those of read_study.
Study sent_study(const std::string& body, const Service& service);
Study sent_study(nlohmann::json document, const Service& service);

/// Throws BadInput: one fault when it is a study, else those of
/// read_whole_scene.
WholeScene sent_scene(const std::string& body, const Service& service);

/// The faults, where a missing file gets a remedy that also suits a sender on another machine.
std::vector<fault::Fault> seen_from_here(std::vector<fault::Fault> faults);

}  // namespace breach::orchestrator
