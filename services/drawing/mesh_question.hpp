// Meshes a scene before its run with fem_solver, and caches the mesh.
#pragma once

#include <filesystem>

#include "services/drawing/section_drawing.hpp"

namespace breach::drawing {

struct Mesher {
    std::filesystem::path fem_solver;  ///< the program
    std::filesystem::path cache;       ///< folder of cached meshes; created when it is missing
};

/// For a draft without faults and with a FEM. Returns the cached mesh for the same section (or mesh
/// file) and program, else makes it. Throws BadInput with the mesher's faults, IoError where
/// fem_solver, gmsh or the folder cannot be used.
DrawnMesh mesh_of(const Draft& draft, const Mesher& mesher);

}  // namespace breach::drawing
