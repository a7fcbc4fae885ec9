#include "core/mechanics/elasticity.hpp"

#include <cmath>

namespace breach::mechanics {

double Elasticity::wave_speed(double rho) const { return std::sqrt(constrained_modulus() / rho); }

Matrix4 elastic_stiffness(const Elasticity& elasticity) {
    const double G = elasticity.shear_modulus();
    const double lambda = elasticity.bulk_modulus() - 2.0 / 3.0 * G;
    Matrix4 D = Matrix4::Zero();
    D.topLeftCorner<3, 3>().setConstant(lambda);
    D.topLeftCorner<3, 3>().diagonal().array() += 2.0 * G;
    D(3, 3) = G;
    return D;
}

Voigt elastic_stress(const Elasticity& elasticity, const Voigt& epsilon) {
    const double G = elasticity.shear_modulus();
    const double lambda = elasticity.bulk_modulus() - 2.0 / 3.0 * G;
    const double volumetric = lambda * (epsilon[0] + epsilon[1] + epsilon[2]);
    return {volumetric + 2.0 * G * epsilon[0], volumetric + 2.0 * G * epsilon[1],
            volumetric + 2.0 * G * epsilon[2], G * epsilon[3]};
}

Voigt elastic_strain(const Elasticity& elasticity, const Voigt& sigma) {
    const double G = elasticity.shear_modulus();
    const double K = elasticity.bulk_modulus();
    const double m = mean_stress(sigma);
    const Voigt s = deviator(sigma);
    const double volumetric = m / (3.0 * K);
    return {s[0] / (2.0 * G) + volumetric, s[1] / (2.0 * G) + volumetric,
            s[2] / (2.0 * G) + volumetric, s[3] / G};
}

double elastic_energy_density(const Elasticity& elasticity, const Voigt& sigma) {
    return 0.5 * double_dot(sigma, elastic_strain(elasticity, sigma));
}

}  // namespace breach::mechanics
