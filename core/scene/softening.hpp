// The soils that lose strength with strain, for the results of FEM and MPM: the service explains
// with them why an accuracy study has no limit.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Factor of softening strains in the FEM: bands of soil with a nonlocal_length are as wide as in the
/// MPM, and /mpm/softening_length is the width for which the strains hold. 1: soil without a length,
/// and scenes without that entry, whose strains hold for the band itself.
double softening_scale_in_fem(const Material& soil, const Scene& scene);

/// {"soils": names of the section's materials that soften, "has_length": whether one of them has a
/// nonlocal_length}; null: none softens.
nlohmann::json softening_in(const Scene& scene);

}  // namespace breach::scene
