// The finite-element mesh: nodes, quads and their regions, from mapped blocks, gmsh or a .msh file.
// Called once per run (run.cpp, mesh_alone.cpp). Nodes and elements keep this order everywhere:
// zones are runs of elements of one region, and free-field columns are appended after them.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/quad.hpp"
#include "core/process/plan.hpp"
#include "core/scene/scene.hpp"

namespace breach::fem {

using geometry::Corners;
using mechanics::Vec2;
using Quad = std::array<std::int32_t, 4>;  ///< corners, counter-clockwise

struct Mesh {
    std::vector<Vec2> nodes;                      ///< [m]
    std::vector<Quad> quads;                      ///< sorted by region
    std::vector<std::int32_t> region_of_element;  ///< ascending
};

Corners corners_of(const Mesh& mesh, std::size_t element);

/// Polled while gmsh runs; true: stop it.
using StopQuestion = std::function<bool()>;
/// Meshing was stopped on request.
class MeshingStopped : public std::exception {};

/// Source of the mesh.
enum class Mesher { msh_file, gmsh, blocks };
process::Decided<Mesher> mesher_of(const scene::Scene& scene);

/// The scene's mesh. `folder`: for gmsh's input and output. Throws BadInput (regions that do not
/// match, elements that are no quads), IoError (gmsh missing, unreadable file), MeshingStopped.
Mesh build_mesh(
    const scene::Scene& scene, const std::filesystem::path& folder,
    const StopQuestion& stop = [] { return false; });

/// A part of a region with one kind of mesh.
struct Piece {
    scene::Region region;  ///< with the part's polygon and divisions
    std::size_t of;        ///< index of the whole region in the section
    double growth = 1.0;   ///< block: ratio of successive element lengths along side 0-1 [-]
    int unit = 1;          ///< block: divisions of a side's segments are multiples of this
};

/// The section's regions in order, graded ones as strips and middle. Throws BadInput if a strip is
/// not a quadrilateral.
std::vector<Piece> pieces_of(const scene::Section& section);

/// Quads by transfinite interpolation of the piece's four sides. Vertices on a side become nodes;
/// the side's divisions are distributed by length. Throws BadInput if a side has more segments than
/// divisions.
Mesh map_block(const Piece& piece);

/// Merges meshes: nodes closer than a millionth of the shortest edge become one. Throws BadInput
/// with every hanging node and gap between regions.
Mesh join(const std::vector<Mesh>& parts, const scene::Section& section);

/// Meshes all regions with the program gmsh; block regions stay structured. Needs `gmsh` on the
/// PATH. When `stop` becomes true, ends it and throws MeshingStopped.
Mesh mesh_with_gmsh(
    const scene::Section& section, const std::filesystem::path& folder,
    const StopQuestion& stop = [] { return false; });

/// Reads a gmsh text mesh (format 2.2 or 4.1) whose physical surfaces have the regions' names.
Mesh read_msh(const std::filesystem::path& file, const scene::Section& section);

/// Measure of all tolerances of places: supports, sides and edges are found within a millionth of
/// shortest_edge.
struct Quality {
    double smallest_angle;  ///< [rad]
    double largest_aspect;  ///< longest side over shortest, worst element [-]
    double least_jacobian;  ///< least corner Jacobian over the element's mean, 1 for parallelograms
                            ///< [-]
    double shortest_edge;   ///< [m]
    double longest_edge;    ///< [m]
    std::size_t worst_element;  ///< element of least_jacobian
};
Quality quality_of(const Mesh& mesh);

/// Points on the side from corner k to corner k+1: divisions + 1, with every vertex. Within a
/// segment, each element is `growth` times as long as the one before. Empty if the side has more
/// segments than divisions.
std::vector<Vec2> divide_side(const geometry::Polygon& polygon, std::size_t from, std::size_t to,
                              int divisions, double growth = 1.0, int unit = 1);

/// Distributes a side's divisions over its segments: at least one `unit` each, the rest by length;
/// `divisions` is a multiple of the unit.
std::vector<int> share_divisions(const std::vector<double>& lengths, int divisions, int unit = 1);

}  // namespace breach::fem
