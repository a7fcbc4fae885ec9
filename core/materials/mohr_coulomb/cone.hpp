// The Mohr-Coulomb cone with tension cut-off at one strength, as bare numbers.
#pragma once

namespace breach::materials {

/// The yield surface at one strength:  k s1 - s3 <= q  and  s1 <= T  for every order of the axes.
/// Flow is m e_i - e_j on the cone (associated when m = k) and e_i on the cut-off (always
/// associated).
struct Cone {
    double k;  ///< (1 + sin phi) / (1 - sin phi) [-], >= 1
    double m;  ///< the same of psi [-], 1 <= m <= k
    double q;  ///< uniaxial compressive strength 2 c sqrt(k) [Pa]
    double T;  ///< largest principal stress [Pa]: the cut-off, or the apex if that is lower; may be
               ///< infinite
    enum class Tip { apex, cut_off } tip;  ///< which of the two T is
};

/// Tension that a soil carries: a number, and at least a share of its unconfined compressive strength.
struct Tension {
    double cutoff;       ///< [Pa] >= 0
    double share = 0.0;  ///< of q [-] >= 0
};

/// c [Pa] >= 0, tan_phi >= tan_psi >= 0.
Cone make_cone(double c, double tan_phi, double tan_psi, const Tension& tension);

}  // namespace breach::materials
