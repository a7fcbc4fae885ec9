// Paths of files that a scene or its overrides name are relative to the scene's folder. A document
// that is sent somewhere else has none: its paths are made absolute first.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace breach::scene {

/// The entries of a scene that name a file, as JSON pointers.
extern const std::array<std::string, 2> file_entries;

/// A file named by its content, "file:sha256/<64 hex digits><ending>": it lies in the folder `files`
/// beside the scene. The ending says how it is read, as that of any file does.
struct FileReference {
    std::string sha256;
    std::string name;  ///< in that folder: the digits and the ending
};
inline constexpr const char* folder_of_references = "files";

/// A study's "scene" that is one which the service keeps begins so: "scene:NAME", "scene:NAME@3",
/// "scene:sha256/<64 hex digits>".
inline constexpr std::string_view stored_scene = "scene:";

/// Nothing: the text is no such reference, but a path.
std::optional<FileReference> file_reference(std::string_view text);
/// name: of the file in its folder.
std::string reference_to(const std::string& name);
/// All that a document names anywhere, in overrides too ("/pointer=file:..."), each once.
std::vector<FileReference> references_in(const nlohmann::json& document);
/// Where the file of an entry lies: path or reference.
std::filesystem::path file_at(const std::filesystem::path& folder, const std::string& entry);
/// The scene's references as absolute paths, where their files lie in this folder: for a scene that is
/// written elsewhere.
void resolve_references(nlohmann::json& scene, const std::filesystem::path& folder);

/// Of the scene itself, references as above. What is not there, or is no text, is left for the scene's reader to judge.
void make_files_absolute(nlohmann::json& scene, const std::filesystem::path& folder);
using ChangeOfPath = std::function<std::string(const std::string& path)>;
/// The path in each override that names a file ("/pointer=path"), wherever a study has overrides:
/// its own, of variants, ladders and parameters. Its scene is left alone.
void change_override_files(nlohmann::json& study, const ChangeOfPath& changed);
void make_override_files_absolute(nlohmann::json& study, const std::filesystem::path& folder);

}  // namespace breach::scene
