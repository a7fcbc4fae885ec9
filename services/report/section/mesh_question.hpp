// The mesh of a scene that has not run: made by fem_solver once, and kept for the next drawing.
#pragma once

#include <filesystem>

#include "services/report/section/section_drawing.hpp"

namespace breach::report {

struct Mesher {
    std::filesystem::path fem_solver;  ///< the program
    std::filesystem::path cache;       ///< folder where meshes are kept; made when it is missing
};

/// Of a draft without faults whose scene has a FEM. The same section (or mesh file) and the same
/// program: the mesh that was kept. Throws BadInput with what the mesher refuses, IoError where
/// fem_solver, gmsh or the folder cannot be used.
DrawnMesh mesh_of(const Draft& draft, const Mesher& mesher);

}  // namespace breach::report
