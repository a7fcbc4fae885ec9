// Newtonian stress beside the law's, 2 eta dev D: an element's nodal forces and its damping matrix.
// dev is the deviator in space, of the plane-strain rate of deformation D.
#pragma once

#include "fem_solver/model/ssp_quad.hpp"

namespace breach::fem {

/// An element's data for its integrals, on the present mesh.
struct ElementOperators {
    const Quadrature& quadrature;
    std::size_t points;
    const SspGeometry*
        hourglass;  ///< of a single-point quad, whose other modes flow as well: 4 eta
                    ///< in place of 4 G; otherwise null
};

/// Viscous forces of the element at nodal velocities v [m/s] for a viscosity eta [Pa s]; [N].
Dofs8 viscous_forces(const ElementOperators& element, double eta, const Dofs8& v);

/// Their derivative with respect to v [N s/m]: symmetric, zero for rigid motion.
Stiffness viscous_damping(const ElementOperators& element, double eta);

}  // namespace breach::fem
