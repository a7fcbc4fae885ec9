// Newtonian stress beside the law's, 2 eta dev D: an element's nodal forces and its damping matrix.
// dev is the deviator in space, of the plane-strain rate of deformation D.
#pragma once

#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

/// What an element's integrals need, of the mesh as it lies.
struct ElementOperators {
    const Quadrature& quadrature;
    std::size_t points;
    const SspGeometry*
        hourglass;  ///< of a single-point quad, whose other modes flow as well: 4 eta
                    ///< stands where 4 G does; otherwise null
};

/// Forces that the element opposes to nodal velocities v [m/s] at a viscosity eta [Pa s]; [N].
Dofs8 viscous_forces(const ElementOperators& element, double eta, const Dofs8& v);

/// Their derivative with respect to v [N s/m]: symmetric, and blind to rigid motion.
Stiffness viscous_damping(const ElementOperators& element, double eta);

}  // namespace breach::fem
