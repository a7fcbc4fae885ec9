#include "core/scene/file_paths.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace breach::scene {

using nlohmann::json;

const std::array<std::string, 2> file_entries{"/fem/msh_file", "/fem/motion/file"};

namespace {

constexpr std::string_view scheme = "file:sha256/";

std::string absolute_in(const std::filesystem::path& folder, const std::string& file) {
    if (file_reference(file)) {
        const std::filesystem::path beside = file_at(folder, file);
        std::error_code error;
        return std::filesystem::exists(beside, error) ? beside.string() : file;
    }
    return std::filesystem::absolute(folder / file).lexically_normal().string();
}

void change_files(json& scene, const ChangeOfPath& changed) {
    for (const std::string& entry : file_entries) {
        const json::json_pointer key(entry);
        if (scene.is_object() && scene.contains(key) && scene[key].is_string())
            scene[key] = changed(scene[key]);
    }
}

void collect_references(const json& value, std::vector<FileReference>& found) {
    if (value.is_structured())
        for (const json& each : value) collect_references(each, found);
    if (!value.is_string()) return;
    const std::string_view text = value.get_ref<const std::string&>();
    const std::size_t at = text.find(scheme);
    if (at == std::string_view::npos || (at > 0 && text[at - 1] != '=')) return;
    const auto reference = file_reference(text.substr(at));
    if (reference && std::ranges::find(found, reference->name, &FileReference::name) == found.end())
        found.push_back(*reference);
}

}  // namespace

std::optional<FileReference> file_reference(std::string_view text) {
    constexpr std::size_t digits = 64;
    if (!text.starts_with(scheme)) return std::nullopt;
    const std::string_view name = text.substr(scheme.size());
    const std::string_view sha256 = name.substr(0, digits);
    const std::string_view ending = name.substr(sha256.size());
    const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    const auto is_plain = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z'); };
    const bool sound = sha256.size() == digits && std::ranges::all_of(sha256, is_hex) &&
                       ending.size() >= 2 && ending.size() <= 8 && ending[0] == '.' &&
                       std::ranges::all_of(ending.substr(1), is_plain);
    if (!sound) return std::nullopt;
    return FileReference{std::string(sha256), std::string(name)};
}

std::string reference_to(const std::string& name) { return std::string(scheme) + name; }

std::vector<FileReference> references_in(const json& document) {
    std::vector<FileReference> found;
    collect_references(document, found);
    return found;
}

std::filesystem::path file_at(const std::filesystem::path& folder, const std::string& entry) {
    const auto reference = file_reference(entry);
    return std::filesystem::absolute(reference ? folder / folder_of_references / reference->name
                                               : folder / entry);
}

void resolve_references(json& scene, const std::filesystem::path& folder) {
    change_files(scene, [&](const std::string& file) {
        return file_reference(file) ? absolute_in(folder, file) : file;
    });
}

void make_files_absolute(json& scene, const std::filesystem::path& folder) {
    change_files(scene, [&](const std::string& file) { return absolute_in(folder, file); });
}

void change_override_files(json& study, const ChangeOfPath& changed) {
    if (study.is_object()) {
        for (const auto& [key, value] : study.items())
            if (key != "scene") change_override_files(value, changed);
    } else if (study.is_array()) {
        for (json& each : study) change_override_files(each, changed);
    } else if (study.is_string()) {
        const std::string text = study;
        for (const std::string& entry : file_entries) {
            const std::string key = entry + "=";
            if (text.starts_with(key)) study = key + changed(text.substr(key.size()));
        }
    }
}

void make_override_files_absolute(json& study, const std::filesystem::path& folder) {
    change_override_files(study,
                          [&](const std::string& file) { return absolute_in(folder, file); });
}

}  // namespace breach::scene
