#include "transfer_tool/points.hpp"

#include <Eigen/LU>
#include <cstdio>

#include "core/fault/fault.hpp"

namespace breach::transfer {
namespace {

using exchange::MeshSnapshot;

constexpr std::size_t most_listed = 5;

std::string describe(const MeshSnapshot& mesh, std::size_t e,
                     const mechanics::JacobianRatio& ratio) {
    const Vec2 centre = deformed_corners(mesh, e).rowwise().mean();
    char text[256];
    std::snprintf(text, sizeof text,
                  "element %zu of region \"%s\" at (%.3f, %.3f) m: |J_t|/|J_0| = %.3g at its "
                  "centre, %.3g at its worst corner",
                  e, mesh.regions[mesh.region_of_element[e]].c_str(), centre.x(), centre.y(),
                  ratio.centre, ratio.least);
    return text;
}

Corners nodal_values(const std::vector<Vec2>& field, const std::array<std::int32_t, 4>& quad) {
    Corners values;
    for (int i = 0; i < 4; ++i) values.col(i) = field[quad[i]];
    return values;
}

void check_undeformed(const MeshSnapshot& mesh, const std::string& file) {
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        if (corner_jacobians(undeformed_corners(mesh, e)).minCoeff() <= 0.0)
            throw fault::BadInput(
                file, {{"/breachline/quads",
                        "element " + std::to_string(e) + " is inverted before any deformation",
                        "give a snapshot whose mesh has convex quads, corners counter-clockwise"}});
}

}  // namespace

Corners undeformed_corners(const MeshSnapshot& mesh, std::size_t element) {
    return nodal_values(mesh.position_0, mesh.quads[element]);
}

Corners deformed_corners(const MeshSnapshot& mesh, std::size_t element) {
    return undeformed_corners(mesh, element) + nodal_values(mesh.displacement, mesh.quads[element]);
}

void refuse_entangled(const MeshSnapshot& mesh, const std::string& file) {
    check_undeformed(mesh, file);
    std::size_t count = 0;
    std::string list;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const auto ratio =
            mechanics::jacobian_ratio(deformed_corners(mesh, e), undeformed_corners(mesh, e));
        if (ratio.least > 0.0) continue;
        if (count++ < most_listed) list += "\n  " + describe(mesh, e, ratio);
    }
    if (count == 0) return;
    if (count > most_listed) list += "\n  and " + std::to_string(count - most_listed) + " more";
    throw fault::Breakdown(file + ": the mesh is entangled at t = " + std::to_string(mesh.time) +
                           " s and cannot be transferred" + list +
                           "\n  remedy: transfer an earlier snapshot");
}

Points place_points(const MeshSnapshot& mesh, int n) {
    const GaussRule rule = gauss_legendre(n);
    const std::size_t per_element = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    const std::size_t count = per_element * mesh.quads.size();
    Points points;
    exchange::ParticleState& s = points.state;
    s.transfer_time = mesh.time;
    s.thickness = mesh.thickness;
    s.regions = mesh.regions;
    s.materials_of_regions = mesh.materials_of_regions;
    for (auto* field : {&s.mass, &s.volume}) field->reserve(count);
    s.position.reserve(count);
    points.xi.reserve(count);
    points.first.push_back(0);
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x_0 = undeformed_corners(mesh, e);
        const Corners x = deformed_corners(mesh, e);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Vec2 xi(rule.position[i], rule.position[j]);
                const double w_t = rule.weight[i] * rule.weight[j] * mesh.thickness;
                points.xi.push_back(xi);
                s.position.emplace_back(x * shape_functions(xi));
                s.mass.push_back(mesh.density[e] * jacobian(x_0, xi).determinant() * w_t);
                s.volume.push_back(jacobian(x, xi).determinant() * w_t);
                s.region.push_back(mesh.region_of_element[e]);
            }
        points.first.push_back(s.position.size());
    }
    s.gap.assign(count, 0.0);
    return points;
}

void carry_nodal_fields(const MeshSnapshot& mesh, Points& points) {
    exchange::ParticleState& s = points.state;
    s.velocity.resize(s.size());
    s.velocity_gradient.resize(s.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = deformed_corners(mesh, e);
        const Corners v = nodal_values(mesh.velocity, mesh.quads[e]);
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
            const Vec2& xi = points.xi[p];
            const Corners dN_dxi = shape_gradients(xi);
            const Matrix2 dx_dxi = jacobian(x, xi);
            const Corners dN_dx = dx_dxi.inverse().transpose() * dN_dxi;
            s.velocity[p] = v * shape_functions(xi);
            s.velocity_gradient[p] = v * dN_dx.transpose();
        }
    }
}

}  // namespace breach::transfer
