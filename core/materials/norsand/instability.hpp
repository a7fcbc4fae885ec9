// How near a point of NorSand is to a flow failure, for whoever watches many of them.
#pragma once

#include <cmath>

#include "core/materials/norsand/law.hpp"

namespace breach::materials {

struct Instability {
    double psi;      ///< state parameter [-]
    double ratio;    ///< eta over eta_L, the limiting stress ratio [-]
    bool past_peak;  ///< sheared on in the plane without drainage, q would fall; with the law's S
};

inline Instability instability(const NorSand& law, const norsand::State& state) {
    const norsand::Reading at = norsand::read(law.ready, state);
    const double ratio = at.eta_L > 0.0 ? at.q / (at.p * at.eta_L) : 0.0;
    Instability out{at.psi, ratio, false};
    const double half = 0.5 * (state.yy - state.xx);  // tension positive, like the strain
    if (std::hypot(half, state.xy) <= 1e-7 * at.p) return out;
    // A strain in the plane along the deviator at constant volume, and what the tangent answers.
    const Voigt along(half, -half, 0.0, -2.0 * state.xy);
    const Voigt s(at.p - state.xx, at.p - state.yy, at.p - state.zz, -state.xy);
    const Voigt rate = plastic_tangent(law.ready, state, along) * along;
    out.past_peak = s[0] * rate[0] + s[1] * rate[1] + s[2] * rate[2] + 2.0 * s[3] * rate[3] < 0.0;
    return out;
}

}  // namespace breach::materials
