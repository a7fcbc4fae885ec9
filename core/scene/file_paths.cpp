#include "core/scene/file_paths.hpp"

#include <nlohmann/json.hpp>

namespace breach::scene {

using nlohmann::json;

const std::array<std::string, 2> file_entries{"/fem/msh_file", "/fem/motion/file"};

namespace {

std::string absolute_in(const std::filesystem::path& folder, const std::string& file) {
    return std::filesystem::absolute(folder / file).lexically_normal().string();
}

void make_absolute(json& overrides, const std::filesystem::path& folder) {
    if (!overrides.is_array()) return;
    for (json& each : overrides) {
        if (!each.is_string()) continue;
        const std::string text = each;
        for (const std::string& entry : file_entries) {
            const std::string key = entry + "=";
            if (text.starts_with(key)) each = key + absolute_in(folder, text.substr(key.size()));
        }
    }
}

/// Of an accuracy study: what all rungs share, and each rung.
void make_rungs_absolute(json& accuracy, const std::filesystem::path& folder) {
    if (accuracy.contains("base")) make_absolute(accuracy["base"], folder);
    if (!accuracy.contains("ladders") || !accuracy["ladders"].is_array()) return;
    for (json& ladder : accuracy["ladders"])
        if (ladder.is_object() && ladder.contains("steps") && ladder["steps"].is_array())
            for (json& step : ladder["steps"]) make_absolute(step, folder);
}

}  // namespace

void make_files_absolute(json& scene, const std::filesystem::path& folder) {
    for (const std::string& entry : file_entries) {
        const json::json_pointer key(entry);
        if (!scene.is_object() || !scene.contains(key) || !scene[key].is_string()) continue;
        scene[key] = absolute_in(folder, scene[key]);
    }
}

void make_override_files_absolute(json& study, const std::filesystem::path& folder) {
    if (!study.is_object()) return;
    if (study.contains("overrides")) make_absolute(study["overrides"], folder);
    if (study.contains("accuracy") && study["accuracy"].is_object())
        make_rungs_absolute(study["accuracy"], folder);
    if (!study.contains("variants") || !study["variants"].is_array()) return;
    for (json& each : study["variants"])
        if (each.is_object() && each.contains("overrides"))
            make_absolute(each["overrides"], folder);
}

}  // namespace breach::scene
