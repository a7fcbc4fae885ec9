// A scene as far as it can be read, so that later checks can add their faults to one complete
// list.
#pragma once

#include <nlohmann/json.hpp>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// With faults, `scene` holds its valid parts: a part with a fault of its own is absent, an invalid
/// polygon is empty, a region with an unknown material names materials.size().
struct Reading {
    Scene scene;
    std::vector<fault::Fault> faults;
    nlohmann::json completed;  ///< with every default filled in; of use only without faults
};

/// As parse_scene, but faults come back beside what could be read. Throws BadInput only where the
/// text is no JSON object.
Reading read_text(std::string_view text, const std::string& name,
                  const std::filesystem::path& folder = ".",
                  const std::vector<std::string>& overrides = {});

/// The same of a document that was parsed already; throws where it is no object.
Reading read_document(nlohmann::json document, const std::string& name,
                      const std::filesystem::path& folder,
                      const std::vector<std::string>& overrides);

/// The text of a scene file. Throws IoError if it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace breach::scene
