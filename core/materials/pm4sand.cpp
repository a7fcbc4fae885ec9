// The door to both schemes, and the tangents.
#include "core/materials/pm4sand.hpp"

#include <cmath>

#include "core/materials/pm4sand_adaptive.hpp"
#include "core/materials/pm4sand_call.hpp"
#include "core/materials/pm4sand_explicit.hpp"

namespace breach::materials::pm4sand {

Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options) {
    const Strain<double> d = inward(d_epsilon);
    if (!is_finite(d)) return {old, Outcome::refused, {}};
    if (options.scheme == Scheme::reference) return integrate_reference(law, old, d, options);
    return integrate_adaptive(law, old, d, options);
}

}  // namespace breach::materials::pm4sand
