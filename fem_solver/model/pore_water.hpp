// Pore water on a mesh: unknown pressures, operators of the saturated elements, force of the
// pressure, steady seepage. For one element: porous_element.hpp.
// Built by ground_water.cpp for scenes, directly by tests.
#pragma once

#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Input of build_pore_water besides the model.
struct Wetness {
    std::vector<std::optional<Fluid>> fluids;       ///< [zones], none where dry
    std::vector<bool> wet;                          ///< [elements]; ignored in zones without fluid
    std::vector<std::optional<double>> prescribed;  ///< [nodes] pressure, none where free [Pa]
    Vec2 body;
    /// [nodes] depth below the phreatic line; empty: all are below [m]
    std::vector<double> depth = {};
    /// The line is hydrostatic as drawn; otherwise the pressure follows from seepage.
    bool rests_as_drawn = false;
};

/// Throws BadInput if a connected saturated body has no prescribed pressure: nothing else
/// determines it.
PoreWater build_pore_water(const Model& model, Wetness wetness);

/// Recomputes all operators, after a change of mobilities or of the stabilisation's modulus.
void evaluate_pore_water(const Model& model, PoreWater& water);

/// f += Q p, the force of the pore pressure on the nodes [N].
void add_pressure_force(const Model& model, const Eigen::VectorXd& p, Eigen::VectorXd& f);

/// Pressure for output [Pa]: 0 above the line, where negative values only serve to make the
/// pressure 0 on the line.
Eigen::VectorXd without_suction(const PoreWater& water, const Eigen::VectorXd& p);

/// Pressure of steady seepage, H p = flux, with the present mobilities; hydrostatic without flow.
/// Throws BadInput if the prescribed pressures do not determine it.
Eigen::VectorXd steady_pressure(const Model& model);

}  // namespace breach::fem
