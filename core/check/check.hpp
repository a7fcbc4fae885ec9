// All faults of a scene that can be found before a run, in the scene and in the files that it
// names, for every phase. Needs no mesh nodes and no results.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/fault/flag.hpp"
#include "core/scene/scene.hpp"

namespace breach::check {

class Recordings;

struct Problems {
    std::vector<fault::Fault> faults;   ///< the scene cannot run
    std::vector<fault::Flag> warnings;  ///< it can run, but is probably not what was meant
};

/// Checks a complete scene, or the valid parts of a faulty one (scene::Reading). Reads the motion
/// and the head of the mesh file; takes a few milliseconds.
Problems problems_of(const scene::Scene& scene);
/// The same for one of many scenes: reads each motion file once.
Problems problems_of(const scene::Scene& scene, Recordings& recordings);

/// A scene with the faults of its reader and of the checks.
struct Checked {
    scene::Scene scene;  ///< its warnings include those of the problems; use only without faults
    std::vector<fault::Fault> faults;
    nlohmann::json completed;  ///< with all defaults; use only without faults
};
/// Arguments of scene::parse_scene. Throws BadInput as scene::read_text does.
Checked checked_text(std::string_view text, const std::string& name,
                     const std::filesystem::path& folder,
                     const std::vector<std::string>& overrides);

/// The same for a parsed document.
Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides, Recordings& recordings);
Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides);

/// scene::read_scene and the checks: throws BadInput with all faults of both, IoError if the file
/// cannot be read.
scene::Scene checked_scene(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides);

}  // namespace breach::check
