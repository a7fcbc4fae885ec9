// Reads a study or a scene as submit and draw send it: the scene inlined and paths absolute,
// because the server does not know the folder of the file. What is wrong inside is left to the
// server, which names the entry.
#include "services/cli/study_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/fault/fault.hpp"
#include "core/scene/file_paths.hpp"
#include "core/scene/schema.hpp"
#include "services/drawing/section_drawing.hpp"

namespace breach::cli {

using nlohmann::json;

namespace {

/// A folder can be opened as a stream on Linux, and would read as empty.
json read_json(const std::filesystem::path& file) {
    std::ostringstream text;
    std::ifstream stream(file, std::ios::binary);
    if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf()))
        throw fault::IoError(file.string() + ": cannot be read");
    return scene::parse_json(text.str(), file.string());
}

/// Relative paths of files in overrides start at the scene's folder.
void add_overrides(json& study, const std::vector<std::string>& overrides,
                   const std::filesystem::path& scene_folder) {
    if (!overrides.empty()) {
        if (!study.contains("overrides")) study["overrides"] = json::array();
        if (!study["overrides"].is_array()) return;  // the server reports the fault
        for (const std::string& each : overrides) study["overrides"].push_back(each);
    }
    scene::make_override_files_absolute(study, scene_folder);
}

}  // namespace

json read_scene_document(const std::filesystem::path& file) {
    json document = read_json(file);
    scene::make_files_absolute(document, file.parent_path());
    return document;
}

bool names_a_scene(const std::filesystem::path& file) {
    const json document = read_json(file);
    return document.is_object() && document.contains("scene");
}

json read_study(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    json study = read_json(file);
    if (!study.is_object()) return study;
    std::filesystem::path scene_folder = file.parent_path();
    if (study.contains("scene") && study["scene"].is_string()) {
        const auto scene = file.parent_path() / study["scene"].get<std::string>();
        scene_folder = scene.parent_path();
        study["scene"] = read_scene_document(scene);
    } else if (study.contains("scene")) {
        scene::resolve_references(study["scene"], scene_folder);  // as in an export
    }
    add_overrides(study, overrides, scene_folder);
    return study;
}

/// Overrides of single variants are left out: `plan` explains one scene, not each variant.
json scene_of_study(const std::filesystem::path& file) {
    drawing::BaseScene base = drawing::base_scene_of(read_study(file, {}));
    check::Checked checked =
        check::checked_document(base.scene, file.string(), file.parent_path(), base.overrides);
    return drawing::draft_of(std::move(base), std::move(checked)).base.scene;
}

/// A file that is no object is sent as it is: the server's fault names the place.
json study_around(const std::filesystem::path& scene, const std::vector<std::string>& overrides) {
    const json document = read_scene_document(scene);
    json study{{"format", "breachline-study/1"}, {"scene", document}};
    study["name"] = document.is_object() ? document.value("name", json("scene")) : json("scene");
    add_overrides(study, overrides, scene.parent_path());
    return study;
}

/// A variant's overrides are applied after the study's, to which --set adds. An override of an
/// entry replaces everything below it, so that a parent counts too. Without this note --set looks
/// ignored.
std::vector<std::string> overruled(const json& study, const std::vector<std::string>& overrides) {
    const auto pointer_of = [](const std::string& each) { return each.substr(0, each.find('=')); };
    const json variants = study.is_object() ? study.value("variants", json()) : json();
    if (!variants.is_array()) return {};
    std::vector<std::string> lines;
    for (const std::string& each : overrides) {
        const std::string wanted = pointer_of(each);
        std::string names;
        for (const json& variant : variants) {
            if (!variant.is_object() || !variant.value("overrides", json()).is_array()) continue;
            for (const json& own : variant["overrides"]) {
                if (!own.is_string()) continue;
                const std::string set = pointer_of(own.get<std::string>());
                if (wanted != set && !wanted.starts_with(set + "/")) continue;
                names += (names.empty() ? "" : ", ") + variant.value("name", std::string("?"));
                break;
            }
        }
        if (!names.empty())
            lines.push_back(wanted +
                            " is set by variants themselves, which keep their own: " + names);
    }
    return lines;
}

}  // namespace breach::cli
