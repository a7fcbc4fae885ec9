// The Mohr-Coulomb cone with tension cut-off at one strength, as plain numbers.
#pragma once

namespace breach::materials {

/// Yield surface  k s1 - s3 <= q  and  s1 <= T  for every order of the axes. Plastic flow is m e_i
/// - e_j on the cone (associated if m = k) and e_i on the cut-off (always associated).
struct Cone {
    double k;  ///< (1 + sin phi) / (1 - sin phi) [-], >= 1
    double m;  ///< (1 + sin psi) / (1 - sin psi) [-], 1 <= m <= k
    double q;  ///< uniaxial compressive strength 2 c sqrt(k) [Pa]
    double T;  ///< largest principal stress [Pa]: the lower of cut-off and apex; may be infinite
    enum class Tip { apex, cut_off } tip;  ///< which of the two is T
};

/// Tensile strength: the larger of a value and a share of the unconfined compressive strength.
struct Tension {
    double cutoff;       ///< [Pa] >= 0
    double share = 0.0;  ///< of q [-] >= 0
};

/// c [Pa] >= 0, tan_phi >= tan_psi >= 0.
Cone make_cone(double c, double tan_phi, double tan_psi, const Tension& tension);

}  // namespace breach::materials
