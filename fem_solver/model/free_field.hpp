// Free-field columns: soil beside the mesh that moves as without the mesh. Geometry and ties; for
// the solver they are thick elements.
// Thick, because the section must not move them: a column of 10,000 times the thickness feels it as
// nothing. Called by build_model only.
#pragma once

#include "fem_solver/model/constraints.hpp"

namespace breach::fem {

/// The mesh without columns, for reports and output.
struct Body {
    std::size_t nodes;
    std::size_t elements;
};

struct FreeFieldColumns {
    std::vector<Tie> ties;  ///< u: edge of the mesh, inner and outer side of the column
    /// p: inner and outer side, not the mesh: the thick column would impose its pressure
    std::vector<Tie> pressure_ties;
    std::vector<std::int32_t> inner;  ///< nodes on the edge of the mesh
};

/// Appends columns, one element wide, after the last node and element, with the levels and regions
/// of the edge. Throws BadInput if a side of the mesh is not one vertical line of element edges.
FreeFieldColumns add_free_field(const scene::FreeField& field, Mesh& mesh);

}  // namespace breach::fem
