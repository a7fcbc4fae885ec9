// Reads the valid parts of a faulty scene, so that later checks can add their faults to one list.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// With faults, `scene` has its valid parts only: a faulty part is absent, an invalid polygon is
/// empty, a region with an unknown material has the index materials.size().
struct Reading {
    Scene scene;
    std::vector<fault::Fault> faults;
    nlohmann::json completed;  ///< with all defaults; use only without faults
};

/// As parse_scene, but returns the faults. Throws BadInput only if the text is no JSON object or
/// has more than fault::most_faults faults.
Reading read_text(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder = ".",
                  const std::vector<std::string>& overrides = {});

/// The same for a parsed document.
Reading read_document(nlohmann::json document, const std::string& name,
                      const std::filesystem::path& folder,
                      const std::vector<std::string>& overrides);

/// The text of a scene file. Throws IoError if it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace breach::scene
