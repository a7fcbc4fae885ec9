// Isotropic linear elasticity in plane strain: moduli, stiffness and wave speed.
#pragma once

#include "core/mechanics/tensor.hpp"

namespace breach::mechanics {

/// E [Pa] > 0 and nu [-] in (-1, 0.5).
struct Elasticity {
    double E;
    double nu;

    double shear_modulus() const { return E / (2.0 * (1.0 + nu)); }
    double bulk_modulus() const { return E / (3.0 * (1.0 - 2.0 * nu)); }
    /// Constrained (P-wave) modulus M = K + 4/3 G [Pa].
    double constrained_modulus() const { return bulk_modulus() + 4.0 / 3.0 * shear_modulus(); }
    /// Speed of a constrained compression wave [m/s] at density rho [kg/m3].
    double wave_speed(double rho) const;
};

/// Softens the soil until its compression wave is at most `limit` [m/s] at density rho: lowers the
/// bulk modulus, down to nu = 0.2; if that is not enough, both moduli.
Elasticity slowed(const Elasticity& elasticity, double rho, double limit);

/// Stiffness D with sigma = D epsilon, engineering shear strain [Pa].
Matrix4 elastic_stiffness(const Elasticity& elasticity);
/// D epsilon without forming D.
Voigt elastic_stress(const Elasticity& elasticity, const Voigt& epsilon);
/// Elastic strain D^-1 sigma.
Voigt elastic_strain(const Elasticity& elasticity, const Voigt& sigma);
/// Elastic energy density sigma : D^-1 sigma / 2 [J/m3].
double elastic_energy_density(const Elasticity& elasticity, const Voigt& sigma);

}  // namespace breach::mechanics
