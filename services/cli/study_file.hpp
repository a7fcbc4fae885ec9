// Prepares a study file for sending: puts in the scene that it names by path.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::cli {

/// The study with its scene inline. A sent study has no folder, so all paths are resolved here: of
/// the scene (relative to the study), of meshes and motions (relative to the scene, in overrides
/// too), and references to files beside the study, as in an export. `overrides` are added to the
/// study's own. The server checks the study. Throws IoError, BadInput (not JSON).
nlohmann::json read_study(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

/// A study with only the scene of this file and its name, without transfer times.
nlohmann::json study_around(const std::filesystem::path& scene,
                            const std::vector<std::string>& overrides);

/// Whether the file is a study: it contains or names a scene. Throws like read_study.
bool names_a_scene(const std::filesystem::path& file);

/// A study's scene with the overrides for all variants.
nlohmann::json scene_of_study(const std::filesystem::path& file);

/// A scene with its mesh's path resolved.
nlohmann::json read_scene_document(const std::filesystem::path& file);

/// Overrides that some variants replace by their own, one line each.
std::vector<std::string> overruled(const nlohmann::json& study,
                                   const std::vector<std::string>& overrides);

}  // namespace breach::cli
