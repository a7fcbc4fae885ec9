// PM4Sand (pm4sand.hpp) in the interface of a law. A point's memory is a pm4sand::State
// (memory.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/materials/memory.hpp"
#include "core/materials/pm4sand/fields.hpp"
#include "core/materials/traits.hpp"

namespace breach::materials {

struct PM4Sand {
    using Memory = pm4sand::State;
    using Update = pm4sand::Update;

    /// of the elastic stages before pm4sand::initialise: G = G_0 p_atm
    mechanics::Elasticity elasticity;
    pm4sand::Ready ready;
    pm4sand::Options options;
};

inline const PM4Sand& ready(const PM4Sand& law) { return law; }

/// The FEM uses the tangent of the elastic predictor, which is symmetric.
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
/// At critical state: friction only.
inline std::optional<Strength> limit_strength(const PM4Sand& law) {
    return Strength{0.0, std::tan(law.ready.parameters.phi_cv)};
}
inline const Softening* softening(const PM4Sand&) { return nullptr; }
inline StrengthEntries strength_entries(PM4Sand&) { return {}; }
/// The surfaces depend on the point's memory: from a stress alone nothing can be said.
inline double yield_excess(const PM4Sand&, const State&) {
    return -std::numeric_limits<double>::infinity();
}
inline Voigt return_to_surface(const PM4Sand&, const State& state) { return state.sigma; }
inline std::optional<LawLanes> for_particles(const PM4Sand&) { return std::nullopt; }

inline pm4sand::State first_memory(const PM4Sand& law, const Voigt& sigma, double epsilon_v) {
    return pm4sand::initialise(law.ready, sigma, epsilon_v, law.options.scheme);
}
inline Voigt stress(const PM4Sand& law, const pm4sand::State& memory) {
    return pm4sand::stress(law.ready, memory);
}
inline void integrate(const PM4Sand& law, std::span<const pm4sand::State> old,
                      std::span<const Voigt> d_epsilon, std::span<pm4sand::Update> updates) {
    pm4sand::integrate(law.ready, old, d_epsilon, law.options, updates);
}
inline Matrix4 elastic_tangent(const PM4Sand& law, const pm4sand::State& memory) {
    return pm4sand::elastic_tangent(law.ready, memory);
}
inline double shear_modulus(const PM4Sand&, const pm4sand::State& memory) { return memory.G; }
/// On the bounding surface: q/p = M_b in the plane.
inline double friction(const PM4Sand&, const pm4sand::State& memory) { return 0.5 * memory.M_b; }
inline bool has_fallen(const PM4Sand&, const pm4sand::State&) { return false; }
inline double stress_outside(const PM4Sand&, const pm4sand::State& memory) {
    const auto& b = memory.sigma_b;
    const double size = std::max({std::abs(b.xx), std::abs(b.yy), std::abs(b.xy)});
    // Round-off of the split into mean and deviator: the stress was inside the surfaces.
    return size <= 1e-9 * memory.p ? 0.0 : size;
}

}  // namespace breach::materials
