// A study file made ready to be sent: the scene that it names by path is put into it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::cli {

/// The study with its scene inline; paths of a scene (relative to the study), of a mesh
/// and of a motion (relative to the scene, in overrides too) are resolved here, because what is
/// sent has no folder; so are references whose
/// files lie beside the study, as in an export. `overrides` are added to the study's own. What the study says is not judged:
/// that is the server's work. Throws IoError, BadInput (not JSON).
nlohmann::json read_study(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

/// A study that holds nothing but the scene of this file, and its name; when to transfer is left
/// open.
nlohmann::json study_around(const std::filesystem::path& scene,
                            const std::vector<std::string>& overrides);

/// The file holds a study: a scene is in it, or named by it. Throws as read_study.
bool names_a_scene(const std::filesystem::path& file);

/// The scene of a study with the study's overrides for all variants. Throws BadInput for one that only the server has.
nlohmann::json scene_of_study(const std::filesystem::path& file);

/// A scene with its mesh's path resolved.
nlohmann::json read_scene_document(const std::filesystem::path& file);

/// What of these overrides some variants of the study set themselves, each as one line: they keep their own.
std::vector<std::string> overruled(const nlohmann::json& study,
                                   const std::vector<std::string>& overrides);

}  // namespace breach::cli
