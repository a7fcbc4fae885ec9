// The head of a mesh file, before its nodes: format and surfaces. fem_solver reads the rest.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace breach::check {

struct MeshHead {
    std::string version;             ///< "4.1" or "2.2"
    std::set<std::string> surfaces;  ///< names of its physical surfaces
};

/// Throws IoError if the file cannot be opened, BadInput if it is no gmsh text mesh of a supported
/// format.
MeshHead read_mesh_head(const std::filesystem::path& file);

}  // namespace breach::check
