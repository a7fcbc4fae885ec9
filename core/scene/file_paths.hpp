// File paths in a scene or its overrides are relative to the scene's folder. Make them absolute
// before sending a document elsewhere.
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

/// JSON pointers of the scene entries that name a file.
extern const std::array<std::string, 2> file_entries;

/// A file identified by its content, "file:sha256/<64 hex digits><extension>", in the folder
/// `files` beside the scene. The extension decides how it is read.
struct FileReference {
    std::string sha256;
    std::string name;  ///< file name: digits and extension
};
inline constexpr const char* folder_of_references = "files";

/// None if the text is a path.
std::optional<FileReference> file_reference(std::string_view text);
/// The reference to a file name in that folder.
std::string reference_to(const std::string& name);
/// All references in a document, each once, also in overrides ("/pointer=file:...").
std::vector<FileReference> references_in(const nlohmann::json& document);
/// Path of a scene entry's file, from a path or a reference.
std::filesystem::path file_at(const std::filesystem::path& folder, const std::string& entry);
/// Replaces the scene's references by absolute paths into this folder, for a scene written
/// elsewhere.
void resolve_references(nlohmann::json& scene, const std::filesystem::path& folder);

/// Makes the scene's file paths absolute. Ignores missing entries and values that are not text; the
/// scene's reader reports them.
void make_files_absolute(nlohmann::json& scene, const std::filesystem::path& folder);
using ChangeOfPath = std::function<std::string(const std::string& path)>;
/// Changes the path in each override that names a file ("/pointer=path"), in all overrides of a
/// study: its own, those of variants, ladders and parameters. The study's scene stays unchanged.
void change_override_files(nlohmann::json& study, const ChangeOfPath& changed);
void make_override_files_absolute(nlohmann::json& study, const std::filesystem::path& folder);

}  // namespace breach::scene
