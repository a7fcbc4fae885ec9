#include "fem_solver/model/build_model.hpp"

#include <cmath>

#include "fem_solver/model/absorbing_base.hpp"
#include "fem_solver/model/ground.hpp"
#include "fem_solver/model/ground_water.hpp"

namespace breach::fem {
namespace {

std::vector<Zone> zones_of(const scene::Scene& scene, const Mesh& mesh, std::size_t points) {
    std::vector<Zone> zones;
    std::size_t sand = 0;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const bool opens = e == 0 || mesh.region_of_element[e] != mesh.region_of_element[e - 1];
        if (opens) {
            const auto& region = scene.section.regions[mesh.region_of_element[e]];
            const auto& material = scene.materials[region.material];
            zones.push_back({e, 0, material.density, material.law, material.viscosity});
        }
        if (opens) zones.back().first_sand = sand;
        if (materials::sand_in(zones.back().law)) sand += points;
        ++zones.back().count;
    }
    return zones;
}

}  // namespace

Model build_model(const scene::Scene& scene, Mesh mesh) {
    const scene::Fem& fem = scene::fem_of(scene);
    Model model;
    model.points_per_element = fem.element == scene::ElementKind::ssp ? 1 : gauss_points;
    model.body = {mesh.nodes.size(), mesh.quads.size()};
    FreeFieldColumns columns;
    if (fem.free_field) {
        columns = add_free_field(*fem.free_field, mesh);
        model.column_thickness = fem.free_field->thickness_factor;
    }
    model.constraints = constraints_of(fem, mesh, columns.ties, columns.pressure_ties);
    model.zones = zones_of(scene, mesh, model.points_per_element);
    model.thickness = scene.thickness;
    model.kinematics = fem.kinematics;
    model.rayleigh = {fem.rayleigh_mass, fem.rayleigh_stiffness};
    model.nodal_mass.assign(mesh.nodes.size(), 0.0);
    model.reference.resize(mesh.quads.size());
    model.volume.resize(mesh.quads.size());
    if (fem.element == scene::ElementKind::ssp) {
        model.hourglass.resize(mesh.quads.size());
        model.hourglass_modulus = fem.hourglass == scene::HourglassKind::elastic
                                      ? HourglassModulus::elastic
                                      : HourglassModulus::current;
    }
    for (const Zone& zone : model.zones) {
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            const Corners x = corners_of(mesh, e);
            const double thickness = model.thickness_of(e);
            Gradients gradients;
            evaluate_gradients(x, thickness, gradients);
            if (fem.element == scene::ElementKind::ssp) {
                evaluate_ssp(x, thickness, model.hourglass[e]);
                use_centre_only(model.hourglass[e], gradients, model.reference[e]);
            } else {
                evaluate_quadrature(gradients, model.reference[e]);
            }
            const Eigen::Vector4d shares = nodal_volumes(x, thickness);
            model.volume[e] = shares.sum();
            for (int k = 0; k < 4; ++k) {
                model.nodal_mass[mesh.quads[e][k]] += zone.density * shares[k];
            }
        }
    }
    const auto dofs = static_cast<Eigen::Index>(2 * mesh.nodes.size());
    model.mass.resize(dofs);
    model.external_force = Eigen::VectorXd::Zero(dofs);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i);
        model.mass.segment<2>(d).setConstant(model.nodal_mass[i]);
        model.external_force[d + 1] = -model.nodal_mass[i] * scene.gravity;
    }
    if (!columns.inner.empty()) model.row_weight = Eigen::VectorXd::Ones(dofs);
    for (const std::int32_t node : columns.inner) {
        model.row_weight.segment<2>(2 * static_cast<Eigen::Index>(node)).array() +=
            1.0 / model.column_thickness;
    }
    model.mesh = std::move(mesh);
    add_ground_loads(scene, model);
    if (fem.water) model.water = ground_water(scene, model);
    if (fem.base) {
        model.base = absorbing_base(model, fem.base->density * fem.base->V_s,
                                    fem.motion ? base_velocity(*fem.motion) : motion::Series{},
                                    fem.base->motion_at);
    }
    return model;
}

}  // namespace breach::fem
