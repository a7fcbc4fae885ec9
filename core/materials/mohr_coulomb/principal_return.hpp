// Exact return to the Mohr-Coulomb cone with tension cut-off, in sorted principal stresses: one
// strength, one trial point, the facet of the polyhedron on which the return ends.
#pragma once

#include <Eigen/Core>

#include "core/materials/lane_law.hpp"
#include "core/materials/mohr_coulomb/cone.hpp"

namespace breach::materials {

/// Sorted principal values s1 >= s2 >= s3: stresses [Pa], tension positive, or strains [-].
using Triple = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// The facet on which a return ends; Q = k T - q is s3 where cone and cut-off meet.
enum class Facet {
    cone_plane,             ///< k s1 - s3 = q
    cone_edge_major,        ///< and s1 = s2
    cone_edge_minor,        ///< and s2 = s3
    cut_plane,              ///< s1 = T
    cut_edge,               ///< s1 = s2 = T
    cut_cone_edge,          ///< s1 = T, s3 = Q
    cut_cone_corner_major,  ///< s1 = s2 = T, s3 = Q
    cut_cone_corner_minor,  ///< s1 = T, s2 = s3 = Q
    tip,                    ///< s1 = s2 = s3 = T
};

struct PrincipalReturn {
    Triple sigma;
    Triple d_epsilon_plastic;
    Facet facet;
};

/// Returns a trial point that lies outside by Koiter's rule: the one facet with non-negative
/// multipliers that violates no other plane (Clausen, Damkilde & Andersen 2006, extended by the
/// cut-off).
PrincipalReturn return_to_cone(const Cone& cone, const Moduli& moduli, const Triple& trial);

/// d sigma / d epsilon of the return in principal axes [Pa].
Matrix3 principal_tangent(const Cone& cone, const Moduli& moduli, Facet facet);

}  // namespace breach::materials
