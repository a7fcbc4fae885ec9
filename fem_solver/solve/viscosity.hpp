// Newtonian stress 2 eta dev D in addition to the law's: nodal forces and damping matrix of an
// element. dev: 3D deviator of the plane-strain rate of deformation D.
// InternalForce adds it in dynamic stages. The MPM has the same entry of a material.
#pragma once

#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

/// Integration data of an element on the undeformed mesh.
struct ElementOperators {
    const Quadrature& quadrature;
    std::size_t points;
    const SspGeometry*
        /// of a single-point quad, whose hourglass modes get 4 eta instead of 4 G; else null
        hourglass;
};

/// Viscous forces of the element [N] at nodal velocities v [m/s] for a viscosity eta [Pa s].
Dofs8 viscous_forces(const ElementOperators& element, double eta, const Dofs8& v);

/// Their derivative by v [N s/m]: symmetric, zero for rigid motion.
Stiffness viscous_damping(const ElementOperators& element, double eta);

}  // namespace breach::fem
