// Pore water in one quad (u-p form, equal order, stabilised): storage, conduction, coupling to the
// skeleton; and the data of a mesh's water. Pressure positive in compression; total stress =
// effective stress - p.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

/// Pore water of a zone; the grains are incompressible.
struct Fluid {
    double bulk_modulus;  ///< K_f [Pa]
    double density;       ///< rho_f [kg/m3]
    Vec2 mobility;        ///< hydraulic conductivity over rho_f g, x and y [m2/(Pa s)]
    double porosity;      ///< n [-]
    /// Pressure-rate stabilisation alpha grad^T grad: alpha = factor h^2 / M in each direction,
    /// with the element's size h and M = min(K + 4G/3, K_f / n) ...
    double stabilisation = 0.25;
    /// ... or one alpha for all [m2/Pa].
    std::optional<double> alpha{};
    scene::PressureIntegration integration = scene::PressureIntegration::full;
};

/// Single-point quad: shortest period of the alternating pressure to be stabilised [s]. alpha for
/// that pressure is at least tau^2 / rho.
inline constexpr double alternation_time = 0.02;

/// Operators of one saturated element.
struct PorousElement {
    std::size_t element;
    std::size_t zone;
    /// M of the stabilisation: K + 4G/3 of the elastic soil, later of its stress when motion begins
    /// [Pa].
    double skeleton_modulus;
    double density;  ///< rho of soil and water [kg/m3]
    /// Share of the integral of N_j that lies below the phreatic line [-]
    Eigen::Vector4d below = Eigen::Vector4d::Ones();
    /// rho_f g times the line's level at the corners, relative to the first [Pa]: its flow
    /// maintains the pressure of the drawn line.
    Eigen::Vector4d level = Eigen::Vector4d::Zero();
    Eigen::Matrix<double, 8, 4> Q;  ///< integral of B^T m N_j dV below the line [m2]
    Eigen::Matrix4d S;              ///< storage n / K_f and stabilisation [m3/Pa]
    Eigen::Matrix4d H;              ///< conduction [m3/(Pa s)]
    Eigen::Vector4d flux;           ///< from the body force, rho_f k b, and from `level` [m3/s]
};

/// Single point. Q is a one-point integral (McGann et al. 2012): a pressure that alternates from
/// node to node exerts no force. Departs from: there L, H and the storage are one-point integrals
/// too, so that such a pressure has neither storage nor drainage; here they are full integrals
/// (docs/reference/methods/pore_pressure.md), unless the fluid requests one point.
void evaluate_porous(const SspGeometry& geometry, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out);
/// 2 x 2 points, full integrals; Q with the mean dilatation of B-bar.
void evaluate_porous(const Gradients& gradients, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out);

/// Saturated elements and unknown pressures; empty if dry.
struct PoreWater {
    std::vector<std::optional<Fluid>> fluids;  ///< [zones] with the present mobility
    std::vector<PorousElement> elements;
    std::vector<bool> is_unknown;  ///< [nodes]
    Eigen::VectorXd prescribed;    ///< [nodes] pressure if not unknown, 0 if dry [Pa]
    Vec2 body = Vec2::Zero();      ///< body acceleration [m/s2]

    bool any() const { return !elements.empty(); }
};

}  // namespace breach::fem
