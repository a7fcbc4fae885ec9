#include "services/orchestrator/study/checked_scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/scene/file_paths.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

/// A scene that was sent has no folder: its files are named by absolute paths, in overrides too.
void need_absolute_files(json scene, const std::vector<std::string>& overrides,
                         std::vector<Fault>& faults) {
    for (const std::string& each : overrides) scene::apply_override(scene, each);
    for (const std::string& key : scene::file_entries) {
        const json::json_pointer at(key);
        if (!scene.contains(at) || !scene[at].is_string() ||
            scene[at].get_ref<const std::string&>().starts_with('/') ||
            scene::file_reference(scene[at].get_ref<const std::string&>()))
            continue;
        faults.push_back(
            {key, "the path is relative, but a scene sent to the service has no folder",
             "send the file (POST /v1/files; breach submit does it) and give the "
             "reference of the answer, or the absolute path on the service's machine"});
    }
}

}  // namespace

check::Checked check_sent_scene(const json& document, const std::vector<std::string>& overrides,
                                const std::filesystem::path& folder) {
    check::Recordings recordings;
    return check_sent_scene(document, overrides, folder, recordings);
}

check::Checked check_sent_scene(const json& document, const std::vector<std::string>& overrides,
                                const std::filesystem::path& folder,
                                check::Recordings& recordings) {
    std::vector<Fault> faults;
    need_absolute_files(document, overrides, faults);
    check::Checked checked =
        check::checked_document(document, "scene", folder, overrides, recordings);
    // A relative path was looked for below the root: one fault is enough.
    std::erase_if(checked.faults, [&](const Fault& each) {
        return std::ranges::find(faults, each.pointer, &Fault::pointer) != faults.end();
    });
    checked.faults.insert(checked.faults.begin(), faults.begin(), faults.end());
    return checked;
}

}  // namespace breach::orchestrator
