// Stored scenes as studies and addresses name them:
//
//     NAME            the newest version of that name
//     NAME@3          its third version
//     sha256/<64>     that content
//
// A study's "scene" puts "scene:" before it. It is resolved once, when the study is submitted: the run
// holds the scene itself, and remembers which it was.
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

/// A name by which a scene may be stored; digits of a hash are none.
bool is_scene_name(const std::string& text);

/// A study with what it is made of.
struct ResolvedStudy {
    std::string text;
    std::optional<SceneSource> made_of;  ///< nothing: it has its scene itself
};

/// Puts the stored scene that the study refers to into it; any other text is left as it is. Throws
/// BadInput with the pointer /scene where there is no such scene.
ResolvedStudy resolved_study(const Store& store, const std::string& text);

}  // namespace breach::orchestrator
