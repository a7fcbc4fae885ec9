// Pore water in the stabilised single-point quad (u-p form): what an element stores, conducts and
// exchanges with the skeleton, and which nodes have a pressure unknown. Pressure is positive in
// compression; total stress = effective stress - p.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fem_solver/model.hpp"

namespace breach::fem {

/// The water in the pores of a zone; grains are incompressible.
struct Fluid {
    double bulk_modulus;  ///< K_f [Pa]
    double density;       ///< rho_f [kg/m3]
    Vec2 mobility;        ///< hydraulic conductivity over rho_f g, x and y [m2/(Pa s)]
    double porosity;      ///< n [-]
    /// alpha of the pressure stabilisation alpha grad^T grad [m2/Pa]; otherwise h^2 / (4 (K +
    /// 4G/3)) in each direction, h the element's extent.
    std::optional<double> stabilisation{};
};

/// Operators of one saturated element.
struct PorousElement {
    std::size_t element;
    Dofs8 Q;               ///< B^T m N_j dV, the same for every pressure j [m2]
    Eigen::Matrix4d S;     ///< storage n / K_f and stabilisation [m3/Pa]
    Eigen::Matrix4d H;     ///< conduction [m3/(Pa s)]
    Eigen::Vector4d flux;  ///< of the body force, rho_f k b [m3/s]
};

/// S is one-point: on its own it leaves the pressure checkerboard free, which a drained edge holds.
PorousElement porous_element(std::size_t element, const SspGeometry& geometry, const Corners& x,
                             double skeleton_modulus, const Fluid& fluid, const Vec2& body);

/// Saturated elements and pressure unknowns; none in dry soil.
struct PoreWater {
    std::vector<PorousElement> elements;
    std::vector<std::int32_t> unknown_of_node;  ///< -1: dry, or its pressure is prescribed
    std::int32_t unknowns = 0;
};

/// fluids: [zones], none where dry. drained: [nodes] true where p = 0 is prescribed. body: body
/// acceleration [m/s2]. The model has single-point quads. Throws BadInput where a connected
/// saturated body has no drained node: its pressure is then not determined once K_f or the
/// checkerboard leave it free.
PoreWater build_pore_water(const Model& model, const std::vector<std::optional<Fluid>>& fluids,
                           const std::vector<bool>& drained, const Vec2& body);

}  // namespace breach::fem
