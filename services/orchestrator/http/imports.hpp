// The answer of POST /v1/import: a drawing converted to a scene. Knows the request's body, but
// nothing of HTTP.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::orchestrator {

/// Stores the text of a motion; returns its name in scenes.
using KeepMotion = std::function<std::string(const std::string& text)>;

/// {scene, report, study}; a study only with an earthquake. Throws BadInput with every fault.
nlohmann::json imported(const std::string& body, const KeepMotion& keep_motion);
/// The same as a picture, SVG: the scene, or the outlines with their faults in red. Throws BadInput
/// where there is nothing to draw.
std::string picture_of_import(const std::string& body);

}  // namespace breach::orchestrator
