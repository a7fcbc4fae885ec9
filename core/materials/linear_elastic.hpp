// Isotropic linear elasticity.
#pragma once

#include <limits>

#include "core/materials/traits.hpp"

namespace breach::materials {

struct LinearElastic {
    mechanics::Elasticity elasticity;
};

inline const LinearElastic& ready(const LinearElastic& law) { return law; }

Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon);
/// The same, and the tangent d sigma / d epsilon [Pa].
Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);

inline Traits traits(const LinearElastic&) {
    return {.type = "linear_elastic",
            .name = "linear elastic",
            .yields = false,
            .opens = false,
            .frictional = false,
            .c_and_phi = false,
            .symmetric_tangent = true,
            .tells_plastic_strain = true};
}
inline std::optional<Strength> limit_strength(const LinearElastic&) { return std::nullopt; }
inline const Softening* softening(const LinearElastic&) { return nullptr; }
inline StrengthEntries strength_entries(LinearElastic&) { return {}; }
inline double yield_excess(const LinearElastic&, const State&) {
    return -std::numeric_limits<double>::infinity();
}
inline Voigt return_to_surface(const LinearElastic&, const State& state) { return state.sigma; }
inline std::optional<LawLanes> for_particles(const LinearElastic&) { return LinearElasticLanes{}; }

}  // namespace breach::materials
