// Stored scenes as studies and addresses name them:
//
//     NAME            the newest version of that name
//     NAME@3          its third version
//     sha256/<64>     that content
//
// A study's "scene" has the prefix "scene:". The reference is resolved once, when the study is
// submitted: the run contains the scene itself, and remembers its origin.
#pragma once

#include <optional>
#include <string>

#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

struct FoundScene {
    StoredScene scene;
    SceneSource source;
};

/// address: one of the three above, or the 64 digits alone. Nothing: there is no such scene.
std::optional<FoundScene> find_scene(const Store& store, const std::string& address);

/// Whether a scene may be stored under this name; the digits of a hash are not a name.
bool is_scene_name(const std::string& text);

/// A study and the stored scene it was made from.
struct ResolvedStudy {
    std::string text;
    std::optional<SceneSource> made_of;  ///< nothing: it contains its scene
};

/// Replaces the study's reference by the stored scene; any other text is unchanged. Throws BadInput
/// with the pointer /scene where there is no such scene.
ResolvedStudy resolved_study(const Store& store, const std::string& text);

}  // namespace breach::orchestrator
