// The finite-element mesh: nodes, quads and their regions, and the three ways to get one (mapped
// blocks, gmsh, a .msh file). No unknowns, no physics.
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

/// Called now and then while gmsh runs; true: stop it.
using StopQuestion = std::function<bool()>;
/// Meshing was stopped on request, and there is no mesh.
class MeshingStopped : public std::exception {};

/// Source of the mesh.
enum class Mesher { msh_file, gmsh, blocks };
process::Decided<Mesher> mesher_of(const scene::Scene& scene);

/// The mesh that the scene asks for. `folder`: where gmsh's input and output are kept. Throws
/// BadInput (regions that do not fit together, a mesh that is not all quads), IoError (gmsh
/// missing, file not readable), MeshingStopped.
Mesh build_mesh(
    const scene::Scene& scene, const std::filesystem::path& folder,
    const StopQuestion& stop = [] { return false; });

/// A part of a region that is meshed in one way.
struct Piece {
    scene::Region region;  ///< with the part's polygon and divisions
    std::size_t of;        ///< index of the whole region in the section
    double growth = 1.0;   ///< block: length of an element over its neighbour's before it, along
                           ///< corner 0-1 [-]
    int unit = 1;          ///< block: the divisions of a side's segments are multiples of this
};

/// The section's regions in their order, graded ones as strips and middle. Throws BadInput when a
/// strip is not a quadrilateral.
std::vector<Piece> pieces_of(const scene::Section& section);

/// Quads mapped from the unit square onto the piece by transfinite interpolation of its four
/// sides. A side's polyline vertices become nodes; its divisions are shared out by length. Throws
/// BadInput when a side has more segments than divisions.
Mesh map_block(const Piece& piece);

/// One mesh from several: nodes closer than a millionth of the shortest edge become one. Throws
/// BadInput with every hanging node and gap between regions, naming both.
Mesh join(const std::vector<Mesh>& parts, const scene::Section& section);

/// Meshes all regions with gmsh's command line; block regions stay structured. Needs `gmsh` on the
/// PATH; ends it, and throws MeshingStopped, soon after `stop` has become true.
Mesh mesh_with_gmsh(
    const scene::Section& section, const std::filesystem::path& folder,
    const StopQuestion& stop = [] { return false; });

/// Reads a gmsh text mesh (format 2.2 or 4.1) whose physical surfaces carry the regions' names.
Mesh read_msh(const std::filesystem::path& file, const scene::Section& section);

struct Quality {
    double smallest_angle;  ///< [rad]
    double largest_aspect;  ///< longest side over shortest, worst element [-]
    double least_jacobian;  ///< least corner Jacobian over the element's mean, 1 for parallelograms
                            ///< [-]
    double shortest_edge;   ///< [m]
    double longest_edge;    ///< [m]
    std::size_t worst_element;  ///< where least_jacobian is
};
Quality quality_of(const Mesh& mesh);

/// Points along the side from corner k to corner k+1, divisions + 1 of them, including every
/// polyline vertex; within a segment, each element is `growth` times as long as the one before.
/// Empty when the side has more segments than divisions.
std::vector<Vec2> divide_side(const geometry::Polygon& polygon, std::size_t from, std::size_t to,
                              int divisions, double growth = 1.0, int unit = 1);

/// Distributes a side's divisions over its segments: at least one `unit` each, otherwise by length;
/// `divisions` is a multiple of the unit.
std::vector<int> share_divisions(const std::vector<double>& lengths, int divisions, int unit = 1);

}  // namespace breach::fem
