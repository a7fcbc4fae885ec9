// The head of a mesh file, before its nodes: its format, to know whether the FEM can read it,
// and its surfaces. fem_solver reads the rest.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace breach::check {

struct MeshHead {
    std::string version;             ///< "4.1" or "2.2"
    std::set<std::string> surfaces;  ///< names of its physical surfaces
};

/// Throws IoError when there is no such file or it cannot be opened; BadInput when it is no gmsh text
/// mesh of a supported format.
MeshHead read_mesh_head(const std::filesystem::path& file);

}  // namespace breach::check
