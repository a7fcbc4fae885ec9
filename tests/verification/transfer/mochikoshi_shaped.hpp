// A snapshot in the shape of the Mochikoshi dam, for transfers without FEM run: the mesh of the
// OpenSees runs (mesh24.json: 919 quads of about 2.4 m, wider far from the dam; made for this
// project, see its note) with invented fields. Stress from depth, hydrostatic water, liquefied down
// to 18.5 m below the pond near the dam, and a slide that rotates about a point above the dam.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/geometry/polygon.hpp"
#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::mochikoshi {

using mechanics::Vec2;

inline const std::vector<Vec2> ground{{-60, 29.4},   {109, 29.4},   {110, 30}, {115, 30},
                                      {168.9, 12.4}, {175.9, 12.4}, {220, 0},  {300, 0}};

/// Share of the slide's motion at a place: 1 inside, decreasing to 0 over 15 m.
inline double sliding(const Vec2& x) {
    const double r = (x - Vec2(135.0, 62.0)).norm();
    const double beyond = std::max({0.0, 90.0 - x.x(), x.x() - 175.0, r < 53.0 ? 0.0 : r - 53.0});
    return std::max(0.0, 1.0 - beyond / 15.0);
}

inline std::int32_t region_at(const scene::Scene& scene, const Vec2& x, int material) {
    const auto named = [&](const std::string& name) {
        for (std::size_t r = 0; r < scene.section.regions.size(); ++r)
            if (scene.section.regions[r].name == name) return static_cast<std::int32_t>(r);
        return 0;
    };
    if (material == 1) return named("tailings");
    if (material == 3) return named("foundation");
    const auto& upper = scene.section.regions[named("upper_dam")].polygon;
    return named(geometry::contains(upper, x) ? "upper_dam" : "lower_dam");
}

/// Reads the mesh without its free-field columns, and sets the nodal fields.
inline exchange::MeshSnapshot nodes_and_elements(const scene::Scene& scene,
                                                 const std::string& mesh_file) {
    std::ifstream stream(mesh_file);
    const nlohmann::json file = nlohmann::json::parse(stream);
    exchange::MeshSnapshot s;
    s.time = 15.0;
    for (const auto& region : scene.section.regions) {
        s.regions.push_back(region.name);
        s.materials_of_regions.push_back(scene.materials[region.material].name);
    }
    for (const auto& node : file.at("nodes")) s.position_0.emplace_back(node[0], node[1]);
    for (std::size_t e = 0; e < file.at("elements").size(); ++e) {
        if (file.at("thickness")[e] > 1.0) continue;
        s.quads.push_back(file.at("elements")[e].get<std::array<std::int32_t, 4>>());
        const Vec2 middle = undeformed_corners(s, s.quads.size() - 1).rowwise().mean();
        s.region_of_element.push_back(region_at(scene, middle, file.at("material")[e]));
        const auto region = static_cast<std::size_t>(s.region_of_element.back());
        s.density.push_back(scene.materials[scene.section.regions[region].material].density);
    }
    s.gauss_per_element = 1;
    s.gauss_positions = {Vec2::Zero()};
    for (const Vec2& x : s.position_0) {
        const double water = geometry::level_at(scene.transfer->phreatic_line, x.x());
        const double u_0 = std::max(0.0, 9810.0 * (water - x.y()));
        const double sigma_v0 =
            std::max(0.0, 18.3e3 * (geometry::level_at(ground, x.x()) - x.y()) - u_0);
        const double depth = 29.4 - x.y();
        const double liquefied = depth < 18.5 && x.x() > 40.0 ? 0.9 : 0.3;
        const Vec2 arm = x - Vec2(135.0, 62.0);
        const Vec2 turn = sliding(x) * Vec2(-arm.y(), arm.x()) / 53.0;
        s.pore_pressure_0.push_back(u_0);
        s.sigma_v0.push_back(sigma_v0);
        s.pore_pressure.push_back(u_0 + liquefied * sigma_v0 * (u_0 > 0.0));
        s.displacement.push_back(1.5 * turn);
        s.velocity.push_back(1.2 * turn + Vec2(0.05 * std::sin(0.1 * x.x()), 0.0));
        s.acceleration.push_back(0.4 * turn);
    }
    s.nodal_mass.assign(s.position_0.size(), 0.0);
    return s;
}

inline exchange::MeshSnapshot snapshot(const scene::Scene& scene, const std::string& mesh_file) {
    exchange::MeshSnapshot s = nodes_and_elements(scene, mesh_file);
    for (std::size_t e = 0; e < s.quads.size(); ++e) {
        const Eigen::Vector4d N = shape_functions(Vec2::Zero());
        const double d_u = (corner_values(s.pore_pressure, s.quads[e]) -
                            corner_values(s.pore_pressure_0, s.quads[e]))
                               .dot(N);
        const double sigma_v = corner_values(s.sigma_v0, s.quads[e]).dot(N) - d_u;
        const double gamma = 0.25 * sliding(undeformed_corners(s, e) * N);
        s.stress.emplace_back(-0.5 * sigma_v, -sigma_v, -0.5 * sigma_v, 0.1 * sigma_v);
        s.strain.emplace_back(0.0, 0.0, 0.0, gamma);
        s.epsilon_q.push_back(gamma / std::sqrt(3.0));
        s.epsilon_q_plastic.push_back(0.9 * gamma / std::sqrt(3.0));
        const Eigen::Vector4d J = corner_jacobians(undeformed_corners(s, e));
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 4; ++k)
                s.nodal_mass[s.quads[e][i]] += s.density[e] * s.thickness * integral(i, k) * J[k];
    }
    return s;
}

}  // namespace breach::transfer::mochikoshi
