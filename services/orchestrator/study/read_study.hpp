// Reads a study: one reader for each kind of question. Of submissions, previews and extensions
// alike, so that a preview refuses exactly what a submission would.
#pragma once

#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// Throws BadInput with every fault; pointers are those of the study ("/scene/materials/...").
Study read_study(std::string_view text, const SentFiles& files = {});
Study read_study_document(nlohmann::json document, const SentFiles& files = {});

struct WholeScene {
    nlohmann::json completed;
    std::vector<fault::Flag> warnings;
};
/// A scene without a study, as in POST /v1/scenes/plan. Throws BadInput.
WholeScene read_whole_scene(const nlohmann::json& document, const SentFiles& files = {});

}  // namespace breach::orchestrator
