#include "fem_solver/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::fem {

Corners corners_of(const Mesh& mesh, std::size_t element) {
    Corners x;
    for (int k = 0; k < 4; ++k) x.col(k) = mesh.nodes[mesh.quads[element][k]];
    return x;
}

namespace {

void check_convex(const Mesh& mesh, const scene::Section& section) {
    const Quality quality = quality_of(mesh);
    if (quality.least_jacobian > 0.0) return;
    const std::int32_t region = mesh.region_of_element[quality.worst_element];
    const Vec2 where = corners_of(mesh, quality.worst_element).rowwise().mean();
    throw fault::BadInput(
        "scene", {{"/section/regions/" + std::to_string(region) + "/mesh",
                   "element " + std::to_string(quality.worst_element) + " of region '" +
                       section.regions[region].name + "' near (" + std::to_string(where.x()) +
                       ", " + std::to_string(where.y()) + ") is not convex",
                   "choose other corners, split the region, or mesh it unstructured"}});
}

}  // namespace

Quality quality_of(const Mesh& mesh) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Quality q{infinity, 0.0, infinity, infinity, 0.0, 0};
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = corners_of(mesh, e);
        const Eigen::Vector4d jacobians = geometry::corner_jacobians(x);
        double shortest = infinity, longest = 0.0, least = infinity, sum = 0.0;
        for (int k = 0; k < 4; ++k) {
            const Vec2 forward = x.col((k + 1) % 4) - x.col(k);
            const Vec2 backward = x.col((k + 3) % 4) - x.col(k);
            const double J = 4.0 * jacobians[k];  // positive in a convex, counter-clockwise quad
            shortest = std::min(shortest, forward.norm());
            longest = std::max(longest, forward.norm());
            least = std::min(least, J);
            sum += J;
            q.smallest_angle =
                std::min(q.smallest_angle, std::abs(std::atan2(J, forward.dot(backward))));
        }
        q.shortest_edge = std::min(q.shortest_edge, shortest);
        q.longest_edge = std::max(q.longest_edge, longest);
        q.largest_aspect = std::max(q.largest_aspect, longest / shortest);
        // The sum is four times the area: an element that is folded as a whole has no meaningful
        // ratio.
        const double ratio = sum > 0.0 ? least / (0.25 * sum) : -1.0;
        if (ratio < q.least_jacobian) {
            q.least_jacobian = ratio;
            q.worst_element = e;
        }
    }
    return q;
}

process::Decided<Mesher> mesher_of(const scene::Scene& scene) {
    const std::string pointer = "/section/regions";
    std::string unstructured;
    for (const scene::Region& region : scene.section.regions) {
        if (region.mesh != scene::RegionMesh::unstructured) continue;
        unstructured += (unstructured.empty() ? "" : ", ") + region.name;
    }
    const bool from_file = scene::fem_of(scene).mesh.msh_file.has_value();
    if (from_file || unstructured.empty())
        return {
            from_file ? Mesher::msh_file : Mesher::blocks,
            {"gmsh", process::Use::left_out, "regions are mapped blocks or a .msh file", pointer}};
    return {Mesher::gmsh, {"gmsh", process::Use::on, "meshes " + unstructured, pointer}};
}

Mesh build_mesh(const scene::Scene& scene, const std::filesystem::path& folder,
                const StopQuestion& stop) {
    const scene::Section& section = scene.section;
    Mesh mesh;
    switch (mesher_of(scene).value) {
        case Mesher::msh_file:
            mesh = read_msh(*scene::fem_of(scene).mesh.msh_file, section);
            break;
        case Mesher::gmsh:
            mesh = mesh_with_gmsh(section, folder, stop);
            break;
        case Mesher::blocks: {
            std::vector<Mesh> parts;
            for (const Piece& piece : pieces_of(section)) parts.push_back(map_block(piece));
            mesh = join(parts, section);
            break;
        }
    }
    // For every source: also a .msh file of a user, and blocks with inward corners.
    check_convex(mesh, section);
    return mesh;
}

}  // namespace breach::fem
