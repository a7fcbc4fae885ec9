// A scene that was sent may name files on the service's machine. Reading one for a stranger would
// give away its contents, or wait for a device that never ends, so every file is judged by its name
// and size before any check opens it.
#include "services/orchestrator/study/checked_scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/scene/file_paths.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;
using fault::Fault;
using nlohmann::json;

namespace {

/// Resolves links and ".." first. A missing file counts by its folder.
bool lies_in(const std::vector<fs::path>& folders, const std::string& file) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    if (error) return false;
    return std::ranges::any_of(folders, [&](const fs::path& each) {
        const fs::path folder = fs::canonical(each, error);
        return !error && std::ranges::mismatch(folder, real).in1 == folder.end();
    });
}

/// Fault of a file that must not be read, because its size is unknown or above the limit. Nothing
/// for a missing file and a folder, which the checks of the scene report.
std::optional<Fault> fault_of_size(const std::string& pointer, const fs::path& file,
                                   std::uintmax_t largest) {
    std::error_code error;
    if (!fs::exists(file, error) || fs::is_directory(file, error)) return std::nullopt;
    const bool regular = fs::is_regular_file(file, error);
    const std::uintmax_t size = regular ? fs::file_size(file, error) : 0;
    if (error || size == 0)  // the size of devices, pipes and files in /proc; they may not end
        return Fault{pointer, file.string() + (regular ? ": is empty" : ": is no ordinary file"),
                     "give a file with a motion or mesh"};
    if (size <= largest) return std::nullopt;
    return Fault{pointer,
                 file.string() + ": has " + std::to_string(size) +
                     " bytes, and this service reads files of at most " + std::to_string(largest),
                 "thin it or cut it, or start the service with a higher --largest-file (MB)"};
}

/// Faults of the files that the scene, with these overrides, names but may not.
std::vector<Fault> forbidden_files(json scene, const std::vector<std::string>& overrides,
                                   const SentFiles& files) {
    std::vector<Fault> faults;
    // An override may name a file as well.
    for (const std::string& each : overrides) scene::apply_override(scene, each);
    for (const std::string& key : scene::file_entries) {
        const json::json_pointer at(key);
        if (!scene.contains(at) || !scene[at].is_string()) continue;
        const auto& file = scene[at].get_ref<const std::string&>();
        if (scene::file_reference(file)) {
            // sent, perhaps when the limit was higher
        } else if (!file.starts_with('/')) {
            faults.push_back(
                {key, "the path is relative, but a scene sent to the service has no folder",
                 "send the file (POST /v1/files; breach submit does it) and give the "
                 "reference of the answer, or the absolute path on the service's machine"});
        } else if (files.allowed && !lies_in(*files.allowed, file)) {
            faults.push_back({key, "this service may not read files there",
                              "send the file (POST /v1/files; breach submit does it) and give the "
                              "reference of the answer, or have its folder allowed: serve "
                              "--allow-folder FOLDER"});
        }
        // Not its size either, which would say that the file exists.
        if (!faults.empty() && faults.back().pointer == key) continue;
        if (auto size = fault_of_size(key, scene::file_at(files.folder, file), files.largest))
            faults.push_back(std::move(*size));
    }
    return faults;
}

}  // namespace

check::Checked check_sent_scene(const json& document, const std::vector<std::string>& overrides,
                                const SentFiles& files) {
    check::Recordings recordings;
    return check_sent_scene(document, overrides, files, recordings);
}

check::Checked check_sent_scene(const json& document, const std::vector<std::string>& overrides,
                                const SentFiles& files, check::Recordings& recordings) {
    const std::vector<Fault> faults = forbidden_files(document, overrides, files);
    // Replaces forbidden files by one that does not exist, to reveal nothing about them.
    std::vector<std::string> changes = overrides;
    for (const Fault& each : faults) changes.push_back(each.pointer + "=/.forbidden");
    check::Checked checked =
        check::checked_document(document, "scene", files.folder, changes, recordings);
    // Faults of the file that is not there would repeat, and contradict, those found here.
    std::erase_if(checked.faults, [&](const Fault& each) {
        return std::ranges::find(faults, each.pointer, &Fault::pointer) != faults.end();
    });
    checked.faults.insert(checked.faults.begin(), faults.begin(), faults.end());
    return checked;
}

/// Throws where the document cannot be read at all; all other faults are in the returned Checked.
check::Checked check_scene_of_study(const std::string& prefix, const json& document,
                                    const std::vector<std::string>& overrides,
                                    const SentFiles& files, check::Recordings& recordings) {
    try {
        return check_sent_scene(document, overrides, files, recordings);
    } catch (const fault::BadInput& error) {
        std::vector<Fault> faults = error.faults();
        for (Fault& each : faults) each.pointer = prefix + each.pointer;
        throw fault::BadInput(prefix.empty() ? error.file() : "study", std::move(faults),
                              error.more());
    }
}

}  // namespace breach::orchestrator
