// Pore water in one quad (u-p form, equal order, stabilised): storage, conduction and coupling to
// the skeleton, and the water of a whole mesh as data. Pressure is positive in compression; total
// stress = effective stress - p.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

/// The water in the pores of a zone; grains are incompressible.
struct Fluid {
    double bulk_modulus;  ///< K_f [Pa]
    double density;       ///< rho_f [kg/m3]
    Vec2 mobility;        ///< hydraulic conductivity over rho_f g, x and y [m2/(Pa s)]
    double porosity;      ///< n [-]
    /// Pressure-rate stabilisation alpha grad^T grad: alpha = factor h^2 / M in each
    /// direction, h the element's extent, M the lesser of K + 4G/3 and K_f / n ...
    double stabilisation = 0.25;
    /// ... or one alpha for all [m2/Pa].
    std::optional<double> alpha{};
    scene::PressureIntegration integration = scene::PressureIntegration::full;
};

/// Shortest time of changes of the alternating pressure between a single-point quad's
/// corners against which it is stabilised [s]: alpha there is tau^2 / rho if that is
/// larger.
inline constexpr double alternation_time = 0.02;

/// Operators of one saturated element.
struct PorousElement {
    std::size_t element;
    std::size_t zone;
    double skeleton_modulus;  ///< K + 4G/3 in the stabilisation [Pa]
    double density;           ///< rho of soil and water [kg/m3]
    /// Share of the integral of N_j that lies below the phreatic line [-]
    Eigen::Vector4d below = Eigen::Vector4d::Ones();
    /// rho_f g times the line's level at the corners, relative to the first: the flow that maintains
    /// the pressure of the line as drawn [Pa]
    Eigen::Vector4d level = Eigen::Vector4d::Zero();
    Eigen::Matrix<double, 8, 4> Q;  ///< integral of B^T m N_j dV below the line [m2]
    Eigen::Matrix4d S;              ///< storage n / K_f and stabilisation [m3/Pa]
    Eigen::Matrix4d H;              ///< conduction [m3/(Pa s)]
    Eigen::Vector4d flux;           ///< of the body force, rho_f k b, and of the level [m3/s]
};

/// Single point. Q is a one-point integral (McGann et al. 2012): a pressure that alternates from
/// node to node exerts no force. Departs from: there L, H and the storage are one-point integrals
/// as well, so that such a pressure has no storage and no drainage; here they are full
/// (docs/reference/methods/pore_pressure.md), unless the fluid asks for one point.
void evaluate_porous(const SspGeometry& geometry, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out);
/// 2 x 2 points: full integrals; Q with the mean dilatation of the skeleton (B-bar).
void evaluate_porous(const Gradients& gradients, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out);

/// Saturated elements, and at which nodes the pressure is unknown; all empty in dry soil.
struct PoreWater {
    std::vector<std::optional<Fluid>> fluids;  ///< [zones] with the mobility now in force
    std::vector<PorousElement> elements;
    std::vector<bool> is_unknown;  ///< [nodes]
    Eigen::VectorXd prescribed;    ///< [nodes] pressure where it is not unknown, 0 in dry soil [Pa]
    Vec2 body = Vec2::Zero();      ///< body acceleration [m/s2]

    bool any() const { return !elements.empty(); }
};

}  // namespace breach::fem
