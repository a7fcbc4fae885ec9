#include "core/mechanics/elasticity.hpp"

#include <algorithm>
#include <cmath>

namespace breach::mechanics {

double Elasticity::wave_speed(double rho) const { return std::sqrt(constrained_modulus() / rho); }

Elasticity slowed(const Elasticity& elasticity, double rho, double limit) {
    if (elasticity.wave_speed(rho) <= limit) return elasticity;
    double G = elasticity.shear_modulus();
    const double most = rho * limit * limit;  // largest constrained modulus
    constexpr double least_nu = 0.2;
    constexpr double least_K = 2.0 * (1.0 + least_nu) / (3.0 * (1.0 - 2.0 * least_nu));  // over G
    double K = std::min(elasticity.bulk_modulus(), std::max(most - 4.0 / 3.0 * G, least_K * G));
    const double factor = std::min(1.0, most / (K + 4.0 / 3.0 * G));
    K *= factor;
    G *= factor;
    return {9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G))};
}

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
    return 0.5 * sigma.dot(elastic_strain(elasticity, sigma));
}

}  // namespace breach::mechanics
