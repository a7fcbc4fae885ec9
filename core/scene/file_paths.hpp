// Paths of files that a scene or its overrides name are relative to the scene's folder. A document
// that is sent somewhere else has none: its paths are made absolute first.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace breach::scene {

/// The entries of a scene that name a file, as JSON pointers.
extern const std::array<std::string, 2> file_entries;

/// Of the scene itself; what is not there, or is no text, is left for the scene's reader to judge.
void make_files_absolute(nlohmann::json& scene, const std::filesystem::path& folder);
/// Of a study's overrides ("/pointer=value"), of those of its variants and of its ladders; its scene
/// is left alone.
void make_override_files_absolute(nlohmann::json& study, const std::filesystem::path& folder);

}  // namespace breach::scene
