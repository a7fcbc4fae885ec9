#include "fem_solver/model.hpp"

#include <cmath>

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
            zones.push_back({e, 0, material.density, material.law});
        }
        if (opens) zones.back().first_sand = sand;
        if (std::holds_alternative<materials::PM4Sand>(zones.back().law)) sand += points;
        ++zones.back().count;
    }
    return zones;
}

Unknowns number_unknowns(const scene::Scene& scene, const Mesh& mesh, double tolerance) {
    const scene::Fem& fem = scene::fem_of(scene);
    std::vector<bool> held(2 * mesh.nodes.size(), false);
    std::vector<fault::Fault> faults;
    bool holds_x = false, holds_y = false;
    for (std::size_t s = 0; s < fem.supports.size(); ++s) {
        const scene::Support& support = fem.supports[s];
        bool found = false;
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            if (scene::distance_to_segment(mesh.nodes[i], support.from, support.to) > tolerance)
                continue;
            found = true;
            if (support.fixes_x) held[2 * i] = true;
            if (support.fixes_y) held[2 * i + 1] = true;
        }
        if (!found) {
            faults.push_back({"/fem/supports/" + std::to_string(s),
                              "support '" + support.name + "' holds no node of the mesh",
                              "let its segment run along an edge of a region"});
        }
        holds_x = holds_x || (found && support.fixes_x);
        holds_y = holds_y || (found && support.fixes_y);
    }
    if (!holds_x || !holds_y) {
        faults.push_back({"/fem/supports",
                          std::string("nothing holds the body in ") + (holds_x ? "y" : "x"),
                          "add a support that fixes this direction"});
    }
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    Unknowns unknowns;
    unknowns.of_dof.assign(held.size(), -1);
    for (std::size_t d = 0; d < held.size(); ++d) {
        if (!held[d]) unknowns.of_dof[d] = unknowns.count++;
    }
    return unknowns;
}

}  // namespace

Model build_model(const scene::Scene& scene, Mesh mesh) {
    const scene::Fem& fem = scene::fem_of(scene);
    Model model;
    model.points_per_element = fem.element == scene::ElementKind::ssp ? 1 : gauss_points;
    model.zones = zones_of(scene, mesh, model.points_per_element);
    model.thickness = scene.thickness;
    model.unknowns = number_unknowns(scene, mesh, 1e-6 * quality_of(mesh).shortest_edge);
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
            Gradients gradients;
            evaluate_gradients(x, scene.thickness, gradients);
            if (fem.element == scene::ElementKind::ssp) {
                evaluate_ssp(x, scene.thickness, model.hourglass[e]);
                use_centre_only(model.hourglass[e], gradients, model.reference[e]);
            } else {
                evaluate_quadrature(gradients, model.reference[e]);
            }
            const Eigen::Vector4d shares = nodal_volumes(x, scene.thickness);
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
    model.mesh = std::move(mesh);
    return model;
}

std::vector<materials::Law> laws_for(const Model& model, scene::StageLaws laws) {
    std::vector<materials::Law> result;
    for (const Zone& zone : model.zones) {
        if (laws == scene::StageLaws::elastic) {
            result.emplace_back(materials::LinearElastic{materials::elasticity(zone.law)});
        } else {
            result.push_back(zone.law);
        }
    }
    return result;
}

Motion at_rest(const Model& model) {
    Motion motion;
    motion.u = motion.v = motion.a = motion.force = Eigen::VectorXd::Zero(model.dofs());
    motion.points.assign(model.points(), State{Voigt::Zero(), 0.0});
    motion.strain.assign(model.points(), Voigt::Zero());
    for (const Zone& zone : model.zones) {
        if (model.hourglass.empty()) break;
        const double G = materials::elasticity(zone.law).shear_modulus();
        motion.hourglass.insert(motion.hourglass.end(), zone.count, {Vec2::Zero(), 4.0 * G, 0.0});
    }
    return motion;
}

Dofs8 gather(const Quad& quad, const Eigen::VectorXd& values) {
    Dofs8 local;
    for (int k = 0; k < 4; ++k) {
        local.segment<2>(2 * k) = values.segment<2>(2 * static_cast<Eigen::Index>(quad[k]));
    }
    return local;
}

Corners displaced_corners(const Model& model, std::size_t element, const Eigen::VectorXd& u) {
    Corners x = corners_of(model.mesh, element);
    for (int k = 0; k < 4; ++k) {
        x.col(k) += u.segment<2>(2 * static_cast<Eigen::Index>(model.mesh.quads[element][k]));
    }
    return x;
}

}  // namespace breach::fem
