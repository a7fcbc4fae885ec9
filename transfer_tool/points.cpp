#include "transfer_tool/points.hpp"

#include <Eigen/LU>
#include <utility>

namespace breach::transfer {
namespace {

using exchange::MeshSnapshot;

void place_in_element(const MeshSnapshot& mesh, std::size_t e, const GaussRule& along,
                      const GaussRule& across, Points& points) {
    const Corners x_0 = undeformed_corners(mesh, e);
    const Corners& x = points.shape[e];
    exchange::ParticleState& s = points.state;
    for (std::size_t j = 0; j < across.position.size(); ++j)
        for (std::size_t i = 0; i < along.position.size(); ++i) {
            const Vec2 xi(along.position[i], across.position[j]);
            const double w_t = along.weight[i] * across.weight[j] * mesh.thickness;
            const std::size_t p = points.xi.size();
            points.xi.push_back(xi);
            s.position[p] = x * shape_functions(xi);
            // Mass from the undeformed element, where the density holds; volume from the deformed
            // one.
            s.mass[p] = mesh.density[e] * jacobian(x_0, xi).determinant() * w_t;
            s.volume[p] = jacobian(x, xi).determinant() * w_t;
            s.region[p] = mesh.region_of_element[e];
        }
    points.first.push_back(points.xi.size());
}

void carry_motion(const MeshSnapshot& mesh, std::size_t e, Points& points) {
    exchange::ParticleState& s = points.state;
    const Corners v = corner_values(mesh.velocity, mesh.quads[e]);
    const Corners a = corner_values(mesh.acceleration, mesh.quads[e]);
    for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
        const Vec2& xi = points.xi[p];
        const Matrix2 dx_dxi = jacobian(points.shape[e], xi);
        const Corners dN_dx = dx_dxi.inverse().transpose() * shape_gradients(xi);
        const Eigen::Vector4d N = shape_functions(xi);
        s.velocity[p] = v * N;
        s.velocity_gradient[p] = v * dN_dx.transpose();
        points.acceleration[p] = a * N;
    }
}

void carry_water(const MeshSnapshot& mesh, std::size_t e, Points& points) {
    const Eigen::Vector4d u = corner_pressure(mesh.pore_pressure, mesh.quads[e], points.shape[e]);
    for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p)
        points.state.pore_pressure[p] = u.dot(shape_functions(points.xi[p]));
}

void carry_ratio(const MeshSnapshot& mesh, std::size_t e, Points& points) {
    const auto at_corners = [&](const std::vector<double>& pressure) {
        return corner_pressure(pressure, mesh.quads[e], points.shape[e]);
    };
    // Numerator and stress are interpolated apart: near the surface, where sigma'_v0 vanishes,
    // ratios at the corners have no limit.
    const Eigen::Vector4d d_u = at_corners(mesh.pore_pressure) - at_corners(mesh.pore_pressure_0);
    const Eigen::Vector4d sigma_v0 = corner_values(mesh.sigma_v0, mesh.quads[e]);
    for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
        const Eigen::Vector4d N = shape_functions(points.xi[p]);
        points.state.r_u[p] = liquefied::pore_pressure_ratio(d_u.dot(N), sigma_v0.dot(N));
    }
}

}  // namespace

Points place_points(const MeshSnapshot& mesh, std::vector<Corners> shapes, const Sampling& sampling,
                    const Shift& shift) {
    Points points;
    points.shape = std::move(shapes);
    exchange::ParticleState& s = points.state;
    s.transfer_time = mesh.time;
    s.thickness = mesh.thickness;
    s.regions = mesh.regions;
    s.materials_of_regions = mesh.materials_of_regions;
    std::size_t count = 0;
    for (const Numbers& each : sampling.numbers)
        count += static_cast<std::size_t>(each[0] * each[1]);
    s.resize(count);
    points.xi.reserve(count);
    points.first.push_back(0);
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        place_in_element(mesh, e, sampling.rule(sampling.numbers[e][0], shift[0]),
                         sampling.rule(sampling.numbers[e][1], shift[1]), points);
    return points;
}

void carry_nodal_fields(const MeshSnapshot& mesh, Points& points) {
    exchange::ParticleState& s = points.state;
    points.acceleration.resize(s.size());
    if (!mesh.pore_pressure.empty()) s.pore_pressure.resize(s.size());
    if (!mesh.sigma_v0.empty()) s.r_u.resize(s.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        carry_motion(mesh, e, points);
        if (!mesh.pore_pressure.empty()) carry_water(mesh, e, points);
        if (!mesh.sigma_v0.empty()) carry_ratio(mesh, e, points);
    }
}

}  // namespace breach::transfer
