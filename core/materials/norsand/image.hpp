// The yield surface's size p_i for a stress or for the limiting hardness (sections 4 and 9), for
// one point.
#pragma once

#include "core/materials/norsand/functions.hpp"

namespace breach::materials::norsand {

/// M_i / M.
double image_share(const Ready& law, double chi_i, double psi_i);

/// chi_i psi_i / M_i,tc = -ln(p_mx / p): how far the limiting hardness lies below p.
double limiting_share(const Ready& law, double chi_i, double psi_i);

/// A stress in the p-q plane on the yield surface.
struct Bullet {
    double p;    ///< [Pa]
    double eta;  ///< q/p
    double M;    ///< critical stress ratio at its Lode angle
    double e, chi_i;
};
/// p_i from F = 0 [Pa].
double image_size(const Ready& law, const Bullet& at);

/// The smaller of p_i and the limiting size p_mx, which itself depends on p_i [Pa].
double capped_size(const Ready& law, double p, double e, double chi_i, double p_i);

}  // namespace breach::materials::norsand
