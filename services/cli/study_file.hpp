// A study file prepared for sending: the scene that it names by path is put into it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::cli {

/// The study with its scene inline; paths of a scene (relative to the study), of a mesh and of a
/// motion (relative to the scene, in overrides too) are resolved here, because a sent study has
/// no folder; so are references to files that lie beside the study, as in an export. `overrides`
/// are added to the study's own. The server checks the study. Throws IoError, BadInput (not
/// JSON).
nlohmann::json read_study(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

/// A study that contains only the scene of this file, and its name; the transfer times are left
/// open.
nlohmann::json study_around(const std::filesystem::path& scene,
                            const std::vector<std::string>& overrides);

/// Whether the file is a study: it contains or names a scene. Throws as read_study.
bool names_a_scene(const std::filesystem::path& file);

/// The scene of a study with the study's overrides for all variants. Throws BadInput for a scene stored by the server.
nlohmann::json scene_of_study(const std::filesystem::path& file);

/// A scene with its mesh's path resolved.
nlohmann::json read_scene_document(const std::filesystem::path& file);

/// Those of these overrides that some variants replace by their own, one line each.
std::vector<std::string> overruled(const nlohmann::json& study,
                                   const std::vector<std::string>& overrides);

}  // namespace breach::cli
