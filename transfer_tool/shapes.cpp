#include "transfer_tool/shapes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/fault/fault.hpp"
#include "core/words/number.hpp"

namespace breach::transfer {
namespace {

using exchange::MeshSnapshot;

constexpr std::size_t most_listed = 5;

std::string describe(const MeshSnapshot& mesh, std::size_t e,
                     const mechanics::JacobianRatio& ratio) {
    const Vec2 centre = deformed_corners(mesh, e).rowwise().mean();
    return words::formatted(
        "element %zu of region \"%s\" at (%.3f, %.3f) m: |J_t|/|J_0| = %.3g at its centre, %.3g at "
        "its worst corner",
        e, mesh.regions[mesh.region_of_element[e]].c_str(), centre.x(), centre.y(), ratio.centre,
        ratio.least);
}

void check_undeformed(const MeshSnapshot& mesh, const std::string& file) {
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        if (corner_jacobians(undeformed_corners(mesh, e)).minCoeff() <= 0.0)
            throw fault::BadInput(
                file, {{"/breachline/quads",
                        "element " + std::to_string(e) + " is inverted before any deformation",
                        "give a snapshot whose mesh has convex quads, corners counter-clockwise"}});
}

/// The undeformed element, rotated to fit the displaced corners (least squares, no reflection) and
/// centred at their mean.
Corners rebuilt(const Corners& x_0, const Corners& x) {
    const Vec2 middle_0 = x_0.rowwise().mean();
    const Vec2 middle = x.rowwise().mean();
    const Corners r_0 = x_0.colwise() - middle_0;
    const Corners r = x.colwise() - middle;
    const double along = (r_0.array() * r.array()).sum();
    const double across =
        (r_0.row(0).array() * r.row(1).array() - r_0.row(1).array() * r.row(0).array()).sum();
    // Corners that have met in one point give no direction.
    const double angle = along == 0.0 && across == 0.0 ? 0.0 : std::atan2(across, along);
    Matrix2 R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return (R * r_0).colwise() + middle;
}

[[noreturn]] void refuse(const MeshSnapshot& mesh, const std::vector<RebuiltElement>& entangled,
                         const std::string& file) {
    std::string list;
    for (std::size_t k = 0; k < std::min(entangled.size(), most_listed); ++k) {
        const std::size_t e = entangled[k].element;
        list += "\n  " + describe(mesh, e,
                                  mechanics::jacobian_ratio(deformed_corners(mesh, e),
                                                            undeformed_corners(mesh, e)));
    }
    if (entangled.size() > most_listed)
        list += "\n  and " + std::to_string(entangled.size() - most_listed) + " more";
    throw fault::Breakdown(file + ": the mesh is entangled at t = " + std::to_string(mesh.time) +
                           " s and cannot be transferred" + list +
                           "\n  remedy: transfer an earlier snapshot, or rebuild such elements "
                           "(/transfer/entangled \"rebuild\")");
}

}  // namespace

Corners deformed_corners(const MeshSnapshot& mesh, std::size_t element) {
    return undeformed_corners(mesh, element) +
           corner_values(mesh.displacement, mesh.quads[element]);
}

Eigen::Vector4d corner_pressure(const std::vector<double>& pressure,
                                const std::array<std::int32_t, 4>& quad, const Corners& x) {
    const Eigen::Vector4d h(1.0, -1.0, 1.0, -1.0), p = corner_values(pressure, quad);
    const Corners dN =
        jacobian(x, Vec2::Zero()).inverse().transpose() * shape_gradients(Vec2::Zero());
    // Amplitude of xi eta: h . p minus the contribution of a linear field on a skewed quad.
    const double amplitude = 0.25 * (h.dot(p) - (x * h).dot(dN * p));
    return p - amplitude * h;
}

Shapes shapes_of_elements(const MeshSnapshot& mesh, scene::Entangled policy,
                          const std::string& file) {
    check_undeformed(mesh, file);
    Shapes shapes;
    shapes.corners.reserve(mesh.quads.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x_0 = undeformed_corners(mesh, e);
        const Corners x = deformed_corners(mesh, e);
        shapes.corners.push_back(x);
        if (corner_jacobians(x).minCoeff() > 0.0) continue;
        shapes.corners.back() = rebuilt(x_0, x);
        shapes.rebuilt.push_back({.element = e,
                                  .region = mesh.regions[mesh.region_of_element[e]],
                                  .centre = x.rowwise().mean(),
                                  .least = mechanics::jacobian_ratio(x, x_0).least,
                                  .area_on_mesh = corner_jacobians(x).sum(),
                                  .area = corner_jacobians(x_0).sum()});
    }
    // After all elements: the message counts them and lists the first ones.
    if (policy == scene::Entangled::refuse && !shapes.rebuilt.empty())
        refuse(mesh, shapes.rebuilt, file);
    return shapes;
}

}  // namespace breach::transfer
