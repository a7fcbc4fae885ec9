// Pore water on a mesh: which nodes have a pressure unknown, the operators of all saturated
// elements, the force of the pressure and steady seepage. One element: porous_element.hpp.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// The input of build_pore_water beside the model.
struct Wetness {
    std::vector<std::optional<Fluid>> fluids;       ///< [zones], none where dry
    std::vector<bool> wet;                          ///< [elements]; of zones without fluid ignored
    std::vector<std::optional<double>> prescribed;  ///< [nodes] pressure, none where free [Pa]
    Vec2 body;
    std::vector<double> depth = {};  ///< [nodes] below the phreatic line; empty: all is below [m]
    /// The line as drawn is in equilibrium; otherwise seepage determines the pressure.
    bool rests_as_drawn = false;
};

/// Throws BadInput where a connected saturated body has no node with a prescribed pressure: then
/// neither K_f nor the checkerboard mode determines its pressure.
PoreWater build_pore_water(const Model& model, Wetness wetness);

/// Recomputes all operators: on the undeformed mesh, or on the mesh displaced by u when it moves.
void evaluate_pore_water(const Model& model, const Eigen::VectorXd& u, PoreWater& water);

/// f += Q p, the force of the pore pressure on the nodes [N].
void add_pressure_force(const Model& model, const Eigen::VectorXd& p, Eigen::VectorXd& f);

/// The pressure for output [Pa]: 0 at nodes above the line, where negative values only serve to
/// make the pressure 0 on the line.
Eigen::VectorXd without_suction(const PoreWater& water, const Eigen::VectorXd& p);

/// Pressure of steady seepage, H p = flux, with the mobilities in force: hydrostatic where nothing
/// drives a flow. Throws BadInput when the prescribed pressures do not determine it.
Eigen::VectorXd steady_pressure(const Model& model);

}  // namespace breach::fem
