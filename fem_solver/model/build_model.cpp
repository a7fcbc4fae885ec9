#include "fem_solver/model/build_model.hpp"

#include <cmath>

#include "core/scene/softening.hpp"
#include "fem_solver/model/absorbing_base.hpp"
#include "fem_solver/model/ground.hpp"
#include "fem_solver/model/ground_water.hpp"
#include "fem_solver/model/nonlocal.hpp"

namespace breach::fem {
namespace {

std::vector<Zone> zones_of(const scene::Scene& scene, const Mesh& mesh) {
    std::vector<Zone> zones;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        // Columns come after the body, so that a region may have a zone in each.
        const bool opens = e == 0 || mesh.region_of_element[e] != mesh.region_of_element[e - 1];
        if (opens) {
            const auto& region = scene.section.regions[mesh.region_of_element[e]];
            const auto& material = scene.materials[region.material];
            const bool softens = materials::softening(material.law) != nullptr;
            zones.push_back({e, 0, material.density, material.law, material.viscosity,
                             material.dynamic_strength,
                             softens ? material.nonlocal_length.value_or(0.0) : 0.0,
                             scene::softening_scale_in_fem(material, scene)});
        }
        ++zones.back().count;
    }
    return zones;
}

}  // namespace

void set_weights(double gravity, double seismic_coefficient, Model& model) {
    const Mesh& mesh = model.mesh;
    model.nodal_mass.assign(mesh.nodes.size(), 0.0);
    for (const Zone& zone : model.zones) {
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            if (model.is_absent(e)) continue;
            const Eigen::Vector4d shares =
                nodal_volumes(corners_of(mesh, e), model.thickness_of(e));
            for (int k = 0; k < 4; ++k)
                model.nodal_mass[mesh.quads[e][k]] += zone.density * shares[k];
        }
    }
    model.mass.resize(model.dofs());
    model.external_force = Eigen::VectorXd::Zero(model.dofs());
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i);
        model.mass.segment<2>(d).setConstant(model.nodal_mass[i]);
        model.external_force[d] = seismic_coefficient * model.nodal_mass[i] * gravity;
        model.external_force[d + 1] = -model.nodal_mass[i] * gravity;
    }
}

Model build_model(const scene::Scene& scene, Mesh mesh) {
    return build_model(scene, decide_model(scene), std::move(mesh));
}

Model build_model(const scene::Scene& scene, const ModelDecisions& decided, Mesh mesh) {
    const auto& hourglass = decided.element.value;
    const auto& base = decided.base.value;
    const auto& motion = decided.motion.value;
    Model model;
    model.points_per_element = hourglass ? 1 : gauss_points;
    // Before the columns are appended: monitors, snapshots and energies end here.
    model.body = {mesh.nodes.size(), mesh.quads.size()};
    FreeFieldColumns columns;
    if (const auto& sides = decided.free_field.value) {
        columns = add_free_field(*sides, mesh);
        model.column_thickness = sides->thickness_factor;
    }
    model.constraints =
        constraints_of(scene::fem_of(scene), base, mesh, columns.ties, columns.pressure_ties);
    model.zones = zones_of(scene, mesh);
    model.thickness = scene.thickness;
    model.rayleigh = decided.damping.value;
    model.reference.resize(mesh.quads.size());
    model.volume.resize(mesh.quads.size());
    if (hourglass) {
        model.hourglass.resize(mesh.quads.size());
        model.hourglass_modulus = *hourglass;
    }
    for (const Zone& zone : model.zones) {
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            const Corners x = corners_of(mesh, e);
            const double thickness = model.thickness_of(e);
            Gradients gradients;
            evaluate_gradients(x, thickness, gradients);
            if (hourglass) {
                evaluate_ssp(x, thickness, model.hourglass[e]);
                use_centre_only(model.hourglass[e], gradients, model.reference[e]);
            } else {
                evaluate_quadrature(gradients, model.reference[e]);
            }
            model.volume[e] = nodal_volumes(x, thickness).sum();
        }
    }
    // See Model::row_weight for the reason of 1 + 1 / thickness.
    if (!columns.inner.empty())
        model.row_weight = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(2 * mesh.nodes.size()));
    for (const std::int32_t node : columns.inner) {
        model.row_weight.segment<2>(2 * static_cast<Eigen::Index>(node)).array() +=
            1.0 / model.column_thickness;
    }
    model.mesh = std::move(mesh);
    model.nonlocal = nonlocal_softening(model);
    // Weights first: loads on the ground are added to the same force.
    set_weights(decided.gravity.value, 0.0, model);
    add_ground_loads(decided, model);
    if (decided.water.value) model.water = ground_water(scene, *decided.water.value, model);
    if (base) {
        model.base =
            absorbing_base(model, base->density * base->V_s,
                           motion ? base_velocity(*motion) : motion::Series{}, base->motion_at);
    }
    return model;
}

}  // namespace breach::fem
