// Meshes with known fields: distorted, deformed, with several regions.
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "transfer_tool/transfer.hpp"

namespace breach::transfer::meshes {

using exchange::MeshSnapshot;
using mechanics::Voigt;

struct Grid {
    int nx = 6;
    int ny = 5;
    double width = 12.0;   ///< [m]
    double height = 10.0;  ///< [m]
    double skew = 0.0;     ///< amplitude of the smooth distortion of the undeformed mesh [cells]
    int regions = 1;       ///< vertical strips
    int gauss = 2;         ///< Gauss points per direction
};

/// Undeformed nodes are moved smoothly by `skew` cells; zero displacement, velocity and stress;
/// density differs by region.
inline MeshSnapshot grid(const Grid& g) {
    MeshSnapshot s;
    s.time = 3.5;
    s.thickness = 1.5;
    const double hx = g.width / g.nx;
    const double hy = g.height / g.ny;
    for (int j = 0; j <= g.ny; ++j)
        for (int i = 0; i <= g.nx; ++i) {
            const double a = g.skew * std::sin(1.7 * i + 2.3 * j);
            const double b = g.skew * std::cos(2.1 * i - 1.3 * j);
            s.position_0.emplace_back(hx * (i + a), hy * (j + b));
        }
    const std::size_t nodes = s.position_0.size();
    for (auto* field : {&s.displacement, &s.velocity, &s.acceleration})
        field->assign(nodes, mechanics::Vec2::Zero());
    s.nodal_mass.assign(nodes, 0.0);
    for (int r = 0; r < g.regions; ++r) {
        s.regions.push_back("strip " + std::to_string(r));
        s.materials_of_regions.push_back("soil");
    }
    const GaussRule rule = gauss_legendre(g.gauss);
    s.gauss_per_element = g.gauss * g.gauss;
    for (int j = 0; j < g.gauss; ++j)
        for (int i = 0; i < g.gauss; ++i)
            s.gauss_positions.emplace_back(rule.position[i], rule.position[j]);
    for (int j = 0; j < g.ny; ++j)
        for (int i = 0; i < g.nx; ++i) {
            const int n = j * (g.nx + 1) + i;
            s.quads.push_back({n, n + 1, n + g.nx + 2, n + g.nx + 1});
            s.region_of_element.push_back(i * g.regions / g.nx);
            s.density.push_back(1800.0 + 150.0 * s.region_of_element.back());
        }
    const std::size_t points = s.quads.size() * s.gauss_positions.size();
    for (auto* field : {&s.stress, &s.strain}) field->assign(points, Voigt::Zero());
    for (auto* field : {&s.epsilon_q, &s.epsilon_q_plastic}) field->assign(points, 0.0);
    // Row sums of the consistent mass matrix.
    for (std::size_t e = 0; e < s.quads.size(); ++e) {
        const Eigen::Vector4d J = corner_jacobians(undeformed_corners(s, e));
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k)
                s.nodal_mass[s.quads[e][i]] += s.density[e] * s.thickness * integral(i, k) * J[k];
    }
    return s;
}

/// Hydrostatic groundwater up to `level`, and the excess pore pressure for r_u(place).
inline void soak(MeshSnapshot& s, double level,
                 const std::function<double(const mechanics::Vec2&)>& r_u) {
    for (const auto& x : s.position_0) {
        const double u_0 = std::max(0.0, 9810.0 * (level - x.y()));
        const double sigma_v0 = std::max(0.0, 9000.0 * (level - x.y()));
        s.pore_pressure_0.push_back(u_0);
        s.sigma_v0.push_back(sigma_v0);
        s.pore_pressure.push_back(u_0 + r_u(x) * sigma_v0);
    }
}

/// A displacement with shear, bulging and area change, and a velocity with every kind of gradient.
inline void set_in_motion(MeshSnapshot& s) {
    for (std::size_t i = 0; i < s.position_0.size(); ++i) {
        const double x = s.position_0[i].x();
        const double y = s.position_0[i].y();
        s.displacement[i] = {0.04 * y + 0.1 * std::sin(0.8 * y), -0.03 * y + 0.05 * std::cos(x)};
        s.velocity[i] = {1.0 + 0.3 * y * y / 10.0, -0.2 * x + std::sin(1.1 * x + y)};
    }
}

inline std::vector<mechanics::Vec2> gauss_places(const MeshSnapshot& s) {
    std::vector<mechanics::Vec2> places;
    for (std::size_t e = 0; e < s.quads.size(); ++e)
        for (const auto& xi : s.gauss_positions)
            places.emplace_back(deformed_corners(s, e) * shape_functions(xi));
    return places;
}

/// Evaluates field(place, region) at every Gauss point, one column.
using Field = std::function<double(const mechanics::Vec2&, int)>;
inline Values at_gauss(const MeshSnapshot& s, const Field& field) {
    const auto places = gauss_places(s);
    Values values(static_cast<Eigen::Index>(places.size()), 1);
    for (std::size_t g = 0; g < places.size(); ++g)
        values(static_cast<Eigen::Index>(g), 0) =
            field(places[g], s.region_of_element[g / s.gauss_positions.size()]);
    return values;
}

inline scene::Transfer settings(int n = 3,
                                scene::Interpolation mode = scene::Interpolation::local) {
    return {.points_per_direction = n,
            .interpolation = mode,
            .neighbours = 40,
            .largest_mass_loss = 1e-12,
            .largest_momentum_loss = 1e-10};
}

/// n x n points in every element, without fields.
inline Points points_on(const MeshSnapshot& s, int n) {
    return place_points(s, shapes_of_elements(s, scene::Entangled::refuse, "mesh").corners,
                        equal_numbers(s.quads.size(), n));
}

/// A transfer that is not stopped.
inline Transferred transferred(const MeshSnapshot& s, const scene::Scene& scene, int threads = 1) {
    return *transfer(s, scene, {.threads = threads}, "mesh");
}

/// Largest and mean-square error of the interpolated field at n x n points per element.
struct FieldError {
    double largest = 0.0;
    double rms = 0.0;
    GaussFieldReport report;
};
inline FieldError field_error(const MeshSnapshot& s, const Field& field,
                              const scene::Transfer& how) {
    const Points points = points_on(s, how.points_per_direction);
    const Interpolated carried = *interpolate(s, at_gauss(s, field), how, {.threads = 2}, points);
    FieldError error{.report = carried.report};
    for (std::size_t p = 0; p < points.state.size(); ++p) {
        const double difference = std::abs(carried.value(static_cast<Eigen::Index>(p), 0) -
                                           field(points.state.position[p], points.state.region[p]));
        error.largest = std::max(error.largest, difference);
        error.rms += difference * difference / static_cast<double>(points.state.size());
    }
    error.rms = std::sqrt(error.rms);
    return error;
}

/// A scene with the regions and materials of the mesh; the transfer ignores the polygons.
inline scene::Scene scene_for(const MeshSnapshot& s, const materials::Law& law,
                              const scene::Transfer& how) {
    scene::Scene scene{};
    scene.gravity = 9.81;
    scene.thickness = s.thickness;
    scene.materials.push_back({"soil", 1800.0, law});
    for (const std::string& name : s.regions)
        scene.section.regions.push_back(
            {.name = name, .material = 0, .polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
    scene.transfer = how;
    return scene;
}

/// Half size of a point's domain with which the weights are hat functions, to round-off.
constexpr double hat = 1e-14;

/// An MPM grid of square cells from the origin.
inline scene::Mpm cells(double size, double width, double height, double half_size = hat) {
    scene::Mpm mpm{};
    mpm.cell_size = size;
    mpm.domain_x = {0.0, width};
    mpm.domain_y = {0.0, height};
    mpm.left = mpm.right = scene::Wall::roller;
    mpm.gimp_half_size = half_size;
    return mpm;
}

/// The row of a ledger; fails if there is none.
inline exchange::LedgerRow row_of(const exchange::Ledger& ledger, const std::string& region,
                                  const std::string& quantity) {
    for (const auto& row : ledger)
        if (row.region == region && row.quantity == quantity) return row;
    throw std::logic_error("no row " + region + ", " + quantity);
}

inline const materials::LinearElastic elastic{{.E = 20e6, .nu = 0.3}};
inline const materials::MohrCoulomb frictional{.elasticity = {.E = 20e6, .nu = 0.3},
                                               .c = 5e3,
                                               .phi = 0.4,
                                               .psi = 0.0,
                                               .tension_cutoff = 0.0,
                                               .softening = {}};

}  // namespace breach::transfer::meshes
