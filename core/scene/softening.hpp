// The soils that lose strength with strain, for the results of FEM and MPM: the service explains
// with them why an accuracy study has no limit.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// {"soils": names of the section's materials that soften, "has_length": whether one of them has a
/// nonlocal_length}; null: none softens.
nlohmann::json softening_in(const Scene& scene);

}  // namespace breach::scene
