// Everything wrong with a scene that can be found before a run: in the scene itself and in the files
// that it names, for every phase in it. Needs no mesh nodes and no results.
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

struct Findings {
    std::vector<fault::Fault> faults;   ///< the scene cannot run
    std::vector<fault::Flag> warnings;  ///< it can run, but is probably not what was meant
};

/// The scene as scene::Reading has it, whole or without its faulty parts. Reads the motion
/// and looks into the mesh file; a few milliseconds.
Findings findings_of(const scene::Scene& scene);
/// The same for one of many scenes: a motion that an earlier one named is not read again.
Findings findings_of(const scene::Scene& scene, Recordings& recordings);

/// The reader's faults and the findings in one.
struct Checked {
    scene::Scene scene;  ///< its warnings hold the findings'; of use only when there are no faults
    std::vector<fault::Fault> faults;
    nlohmann::json completed;  ///< with every default filled in; of use only without faults
};
/// As scene::parse_scene takes it. Throws BadInput only where the text is no JSON object.
Checked checked_text(std::string_view text, const std::string& name,
                     const std::filesystem::path& folder,
                     const std::vector<std::string>& overrides);

/// The same of a document that was parsed already.
Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides, Recordings& recordings);
Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides);

/// scene::read_scene with the findings: throws BadInput with every fault of both, IoError if the
/// file cannot be read.
scene::Scene checked_scene(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides);

}  // namespace breach::check
