// Paths of files in a scene or its overrides are relative to the scene's folder. A document that is
// sent elsewhere has no folder: its paths are made absolute first.
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
/// beside the scene. The ending decides how it is read, as for any file.
struct FileReference {
    std::string sha256;
    std::string name;  ///< in that folder: the digits and the ending
};
inline constexpr const char* folder_of_references = "files";

/// Prefix of a study's "scene" that refers to a scene stored by the service: "scene:NAME",
/// "scene:NAME@3", "scene:sha256/<64 hex digits>".
inline constexpr std::string_view stored_scene = "scene:";

/// Nothing: the text is a path, not such a reference.
std::optional<FileReference> file_reference(std::string_view text);
/// name: of the file in its folder.
std::string reference_to(const std::string& name);
/// All references that a document contains, in overrides too ("/pointer=file:..."), each once.
std::vector<FileReference> references_in(const nlohmann::json& document);
/// The file of an entry: path or reference.
std::filesystem::path file_at(const std::filesystem::path& folder, const std::string& entry);
/// Replaces the scene's references by absolute paths into this folder: for a scene that is written
/// elsewhere.
void resolve_references(nlohmann::json& scene, const std::filesystem::path& folder);

/// The same for the scene itself. Missing entries, or entries that are no text, are left for the scene's reader to judge.
void make_files_absolute(nlohmann::json& scene, const std::filesystem::path& folder);
using ChangeOfPath = std::function<std::string(const std::string& path)>;
/// The path in each override that names a file ("/pointer=path"), in all of a study's overrides:
/// its own, those of variants, ladders and parameters. Its scene is not changed.
void change_override_files(nlohmann::json& study, const ChangeOfPath& changed);
void make_override_files_absolute(nlohmann::json& study, const std::filesystem::path& folder);

}  // namespace breach::scene
