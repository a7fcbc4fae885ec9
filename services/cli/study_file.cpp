#include "services/cli/study_file.hpp"

#include <fstream>
#include <sstream>

#include "core/fault/fault.hpp"
#include "core/scene/schema.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

json read_json(const std::filesystem::path& file) {
    std::ostringstream text;
    std::ifstream stream(file, std::ios::binary);
    if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf()))
        throw fault::IoError(file.string() + ": cannot be read");
    return scene::parse_json(text.str(), file.string());
}

void make_absolute(json& object, const char* key, const std::filesystem::path& folder) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return;
    object[key] =
        std::filesystem::absolute(folder / object[key].get<std::string>()).lexically_normal();
}

/// A path in an override is relative to the scene, like the entry that it replaces.
void make_overrides_absolute(json& overrides, const std::filesystem::path& folder) {
    if (!overrides.is_array()) return;
    for (json& each : overrides) {
        if (!each.is_string()) continue;
        for (const std::string key : {"/fem/msh_file=", "/fem/motion/file="}) {
            const std::string text = each;
            if (!text.starts_with(key)) continue;
            each = key + std::filesystem::absolute(folder / text.substr(key.size()))
                             .lexically_normal()
                             .string();
        }
    }
}

}  // namespace

json read_scene_document(const std::filesystem::path& file) {
    json scene = read_json(file);
    if (scene.is_object() && scene.contains("fem") && scene["fem"].is_object()) {
        make_absolute(scene["fem"], "msh_file", file.parent_path());
        if (scene["fem"].contains("motion"))
            make_absolute(scene["fem"]["motion"], "file", file.parent_path());
    }
    return scene;
}

json read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    json study = read_json(file);
    if (!study.is_object()) return study;
    std::filesystem::path scene_folder = file.parent_path();
    if (study.contains("scene") && study["scene"].is_string()) {
        const auto scene = file.parent_path() / study["scene"].get<std::string>();
        scene_folder = scene.parent_path();
        study["scene"] = read_scene_document(scene);
    }
    if (!overrides.empty()) {
        if (!study.contains("overrides")) study["overrides"] = json::array();
        if (!study["overrides"].is_array()) return study;  // the server says what is wrong with it
        for (const std::string& each : overrides) study["overrides"].push_back(each);
    }
    if (study.contains("overrides")) make_overrides_absolute(study["overrides"], scene_folder);
    if (study.contains("variants") && study["variants"].is_array()) {
        for (json& each : study["variants"]) {
            if (each.is_object() && each.contains("overrides"))
                make_overrides_absolute(each["overrides"], scene_folder);
        }
    }
    return study;
}

}  // namespace breach::cli
