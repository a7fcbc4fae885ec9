// Free-field columns: soil beside the mesh that moves as it would without the mesh. Geometry and
// ties only; for the solver they are thick elements like others.
#pragma once

#include "fem_solver/model/constraints.hpp"

namespace breach::fem {

/// The mesh without the columns: reports and outputs cover only this part.
struct Body {
    std::size_t nodes;
    std::size_t elements;
};

struct FreeFieldColumns {
    std::vector<Tie> ties;            ///< u: edge of the mesh, inner and outer side of the column
    std::vector<Tie> pressure_ties;   ///< p: inner and outer side; never the mesh, which the thick
                                      ///< column would keep at its own pressure
    std::vector<std::int32_t> inner;  ///< nodes on the edge of the mesh
};

/// Appends one-element-wide columns behind the last node and element of the mesh, with the edge's
/// own levels and regions. Throws BadInput when a side of the mesh is not one vertical line of
/// element edges.
FreeFieldColumns add_free_field(const scene::FreeField& field, Mesh& mesh);

}  // namespace breach::fem
