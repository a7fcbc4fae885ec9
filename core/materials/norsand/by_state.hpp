// The undrained strength of level ground of NorSand as a function of place: of the law's own path in
// simple shear from sigma'_v0, K_0 and psi_0 there, tabulated once.
#pragma once

#include <vector>

#include "core/materials/norsand/law.hpp"

namespace breach::materials {

/// The largest shear stress of the path, or that of the critical state.
enum class OnPath { peak, residual };

class StrengthByState {
  public:
    /// S, K_0 and the state parameter are the law's.
    StrengthByState(const NorSand& law, OnPath part);

    /// tau on a plane along level ground [Pa] at a place with the pore pressure u [Pa]. Never above
    /// tau of the critical state at p' + u: no suction is counted on.
    double at(const Place& place, double u) const;

  private:
    /// tau / sigma'_v0 of the path from this vertical effective stress [Pa].
    double ratio_from(double psi, double sigma_v0) const;

    NorSand law_;
    OnPath part_;
    double tau_over_p_;              ///< at the critical state
    std::vector<double> psi_;        ///< ascending; one: the same everywhere, or of e_0
    std::vector<double> ln_stress_;  ///< ascending
    std::vector<double> ln_ratio_;   ///< [psi][stress] of tau / sigma'_v0
};

}  // namespace breach::materials
