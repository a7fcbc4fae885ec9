// PM4Sand (pm4sand.hpp) as one of the laws. Its points remember more than State holds: whoever runs
// it keeps a pm4sand::State beside it, whose stress State mirrors. There is no `integrate` for it
// here.
#pragma once

#include <cmath>
#include <limits>

#include "core/materials/pm4sand/pm4sand.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

struct PM4Sand {
    mechanics::Elasticity elasticity;  ///< of the stages before pm4sand::initialise: G = G_0 p_atm
    pm4sand::Ready ready;
    pm4sand::Options options;
};

inline const PM4Sand& ready(const PM4Sand& law) { return law; }

/// Its tangent in the FEM is the elastic predictor's, which is symmetric.
inline Traits traits(const PM4Sand&) {
    return {.type = "pm4sand",
            .name = "PM4Sand",
            .yields = true,
            .opens = false,
            .frictional = true,
            .c_and_phi = false,
            .symmetric_tangent = true,
            .tells_plastic_strain = false};
}
/// Sand at critical state: friction alone.
inline std::optional<Strength> limit_strength(const PM4Sand& law) {
    return Strength{0.0, std::tan(law.ready.parameters.phi_cv)};
}
inline const Softening* softening(const PM4Sand&) { return nullptr; }
inline StrengthEntries strength_entries(PM4Sand&) { return {}; }
/// Its surfaces follow what its points remember: a stress alone is neither inside nor outside.
inline double yield_excess(const PM4Sand&, const State&) {
    return -std::numeric_limits<double>::infinity();
}
inline Voigt return_to_surface(const PM4Sand&, const State& state) { return state.sigma; }
inline std::optional<LawLanes> for_particles(const PM4Sand&) { return std::nullopt; }

}  // namespace breach::materials
