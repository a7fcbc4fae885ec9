// What a mesh file says of itself before its nodes: enough to know whether it is one that the FEM
// reads, and its surfaces. fem_solver reads the rest.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace breach::check {

struct MeshHead {
    std::string version;             ///< "4.1" or "2.2"
    std::set<std::string> surfaces;  ///< names of its physical surfaces
};

/// Throws IoError when the file is none, or cannot be opened; BadInput when it is no gmsh text mesh of
/// a format that is read.
MeshHead read_mesh_head(const std::filesystem::path& file);

}  // namespace breach::check
