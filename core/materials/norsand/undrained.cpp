#include "core/materials/norsand/undrained.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breach::materials::norsand {

double plane_shear(const State& state) { return std::hypot(0.5 * (state.xx - state.yy), state.xy); }
double simple_shear(const State& state) { return std::abs(state.xy); }

namespace {

/// The largest shear on the way along a direction of strain, and what is left of it. At the critical
/// state simple shear and shear in the plane are one.
UndrainedStrength strength_along(const Ready& law, const State& state, const Voigt& along,
                                 double bound, double (&shear_of)(const State&)) {
    constexpr double first_step = 1e-4, growth = 1.05, largest_step = 5e-3;  // strain
    constexpr double farthest = 0.3, past = 0.9;                             // strain; of the peak
    const double theta = plane_critical_angle(law);
    const double ratio = critical_ratio(law, theta) * std::cos(theta) / std::numbers::sqrt3;
    const double most = ratio * std::max(bound, law.parameters.p_min);
    const double p_c = std::max(critical_pressure(law, state.e), law.parameters.p_min);

    double peak = shear_of(state);
    State at = state;
    double step = first_step;
    for (double gone = 0.0; gone < farthest && peak < most; gone += step) {
        const Update next = integrate(law, at, step * along, {});
        if (next.outcome != Outcome::done) break;
        at = next.state;
        const double shear = shear_of(at);
        if (shear < past * peak) break;
        peak = std::max(peak, shear);
        step = std::min(growth * step, largest_step);
    }
    peak = std::max(std::min(peak, most), shear_of(state));
    return {peak, std::min({ratio * p_c, most, peak})};
}

}  // namespace

UndrainedStrength undrained_strength(const Ready& law, const State& state, double bound) {
    const double half = 0.5 * (state.yy - state.xx);  // tension positive, like the strain
    const double size = std::hypot(half, state.xy);
    // Without a direction of its own it is compressed along y.
    const bool turned = size > 1e-7 * (state.xx + state.yy + state.zz);
    const Voigt along = turned ? Voigt(half / size, -half / size, 0.0, -2.0 * state.xy / size)
                               : Voigt(1.0, -1.0, 0.0, 0.0);
    return strength_along(law, state, along, bound, plane_shear);
}

UndrainedStrength simple_shear_strength(const Ready& law, const State& state, double bound) {
    return strength_along(law, state, Voigt(0.0, 0.0, 0.0, 1.0), bound, simple_shear);
}

}  // namespace breach::materials::norsand
