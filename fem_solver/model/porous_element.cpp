#include "fem_solver/model/porous_element.hpp"

#include <algorithm>

namespace breach::fem {
namespace {

/// In rock stiffer than its water (K_f / n, 5 GPa), use the water's compliance: with the
/// skeleton's, a pressure jump at soft soil would continue as an undamped zig-zag.
Vec2 stabilisation_of(const Corners& x, const Fluid& fluid, double skeleton_modulus) {
    if (fluid.alpha) return Vec2::Constant(*fluid.alpha);
    const Vec2 extent = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
    const double modulus = std::min(skeleton_modulus, fluid.bulk_modulus / fluid.porosity);
    return fluid.stabilisation / modulus * extent.array().square();
}

/// Integral of N_i N_j over the element, for a volume of 1 m3.
Eigen::Matrix4d unit_mass(const Corners& x) {
    Gradients gradients;
    evaluate_gradients(x, 1.0, gradients);
    Eigen::Matrix4d mass = Eigen::Matrix4d::Zero();
    double volume = 0.0;
    for (std::size_t g = 0; g < gauss_points; ++g) {
        const Eigen::Vector4d N = shape_functions(gauss_positions()[g]);
        mass += gradients.weight[g] * N * N.transpose();
        volume += gradients.weight[g];
    }
    return mass / volume;
}

}  // namespace

void evaluate_porous(const SspGeometry& geometry, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out) {
    const Gradient& dN = geometry.dN;
    const double V = geometry.volume, compliance = V * fluid.porosity / fluid.bulk_modulus;
    const Vec2 alpha = stabilisation_of(x, fluid, out.skeleton_modulus);
    for (int i = 0; i < 4; ++i) {
        // Only the part below the line pushes: u and sigma' are those of the line as drawn.
        out.Q.middleRows<2>(2 * i) = 0.25 * V * dN.col(i) * out.below.transpose();
    }
    out.S.noalias() = V * dN.transpose() * alpha.asDiagonal() * dN;
    out.H.noalias() = V * dN.transpose() * fluid.mobility.asDiagonal() * dN;
    if (fluid.integration == scene::PressureIntegration::full) {
        // The gradient of xi eta, with the amplitude gamma: zero for linear pressures, so that
        // seepage along a line is exact on skewed quads.
        const Eigen::Matrix4d alternating = geometry.gamma * geometry.gamma.transpose();
        const Vec2 kappa = 4.0 * geometry.H.diagonal();
        const double most = alternation_time * alternation_time / out.density;
        out.S += compliance * unit_mass(x) + kappa.dot(alpha.cwiseMax(most)) * alternating;
        out.H += kappa.dot(fluid.mobility) * alternating;
    } else {
        // As OpenSees: all four nodes share one storage, which an alternating pressure does not
        // feel.
        out.S.array() += compliance / 16.0;
    }
    out.flux.noalias() = V * fluid.density * dN.transpose() * fluid.mobility.cwiseProduct(body);
    out.flux += out.H * out.level;
}

void evaluate_porous(const Gradients& gradients, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out) {
    const Vec2 alpha = stabilisation_of(x, fluid, out.skeleton_modulus);
    out.S.setZero();
    out.H.setZero();
    out.flux.setZero();
    Gradient mean = Gradient::Zero();
    Eigen::Vector4d shares = Eigen::Vector4d::Zero();
    for (std::size_t g = 0; g < gauss_points; ++g) {
        const Gradient& dN = gradients.dN[g];
        const double w = gradients.weight[g];
        const Eigen::Vector4d N = shape_functions(gauss_positions()[g]);
        // As in B-bar: the pressures work on one volumetric strain per element, or it would lock
        // again.
        mean += w * dN;
        shares += w * N;
        out.S += w * fluid.porosity / fluid.bulk_modulus * N * N.transpose();
        out.S += w * dN.transpose() * alpha.asDiagonal() * dN;
        out.H += w * dN.transpose() * fluid.mobility.asDiagonal() * dN;
        out.flux += w * fluid.density * dN.transpose() * fluid.mobility.cwiseProduct(body);
    }
    mean /= shares.sum();
    out.flux += out.H * out.level;
    for (int i = 0; i < 4; ++i) {
        out.Q.middleRows<2>(2 * i) = mean.col(i) * shares.cwiseProduct(out.below).transpose();
    }
}

}  // namespace breach::fem
