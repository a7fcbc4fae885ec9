// Pore water in the quads (u-p form, equal order, stabilised): what an element stores, conducts and
// exchanges with the skeleton, and which nodes have a pressure unknown. Pressure is positive in
// compression; total stress = effective stress - p.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fem_solver/model/constraints.hpp"
#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

struct Model;

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
};

/// Operators of one saturated element.
struct PorousElement {
    std::size_t element;
    std::size_t zone;
    double skeleton_modulus;        ///< K + 4G/3 that the stabilisation is measured by [Pa]
    Eigen::Matrix<double, 8, 4> Q;  ///< integral of B^T m N_j dV [m2]
    Eigen::Matrix4d S;              ///< storage n / K_f and stabilisation [m3/Pa]
    Eigen::Matrix4d H;              ///< conduction [m3/(Pa s)]
    Eigen::Vector4d flux;           ///< of the body force, rho_f k b [m3/s]
};

/// Single point: one-point integrals (McGann et al. 2012). S is of rank one: on its own it leaves
/// the pressure checkerboard free, which a drained edge holds.
void evaluate_porous(const SspGeometry& geometry, const Corners& x, const Fluid& fluid,
                     const Vec2& body, PorousElement& out);
/// 2 x 2 points: full integrals; Q with the mean dilatation that the skeleton sees (B-bar).
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

/// What build_pore_water needs beside the model.
struct Wetness {
    std::vector<std::optional<Fluid>> fluids;       ///< [zones], none where dry
    std::vector<bool> wet;                          ///< [elements]; of zones without fluid ignored
    std::vector<std::optional<double>> prescribed;  ///< [nodes] pressure, none where free [Pa]
    Vec2 body;
};

/// Throws BadInput where a connected saturated body has no node with a prescribed pressure: its
/// pressure is then not determined once K_f or the checkerboard leave it free.
PoreWater build_pore_water(const Model& model, Wetness wetness);

/// All operators anew: on the undeformed mesh, or on the mesh displaced by u when it moves.
void evaluate_pore_water(const Model& model, const Eigen::VectorXd& u, PoreWater& water);

/// f += Q p, the force of the pore pressure on the nodes [N].
void add_pressure_force(const Model& model, const Eigen::VectorXd& p, Eigen::VectorXd& f);

/// Pressure of steady seepage, H p = flux, with the mobilities in force: hydrostatic where nothing
/// drives a flow. Throws BadInput when the prescribed pressures do not determine it.
Eigen::VectorXd steady_pressure(const Model& model);

}  // namespace breach::fem
