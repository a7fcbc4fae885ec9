#include "fem_solver/mesh_alone.hpp"

#include "core/exchange/mesh_snapshot.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {

namespace {

/// Zero displacement and stress.
exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, Mesh mesh) {
    exchange::MeshSnapshot snapshot;
    snapshot.thickness = scene.thickness;
    for (const scene::Region& each : scene.section.regions) {
        snapshot.regions.push_back(each.name);
        snapshot.materials_of_regions.push_back(scene.materials[each.material].name);
    }
    const std::size_t nodes = mesh.nodes.size(), elements = mesh.quads.size();
    for (auto* each : {&snapshot.displacement, &snapshot.velocity, &snapshot.acceleration})
        each->assign(nodes, Vec2::Zero());
    snapshot.nodal_mass.assign(nodes, 0.0);
    for (const std::int32_t region : mesh.region_of_element)
        snapshot.density.push_back(scene.material_of(region).density);
    // The format has no mesh without state: one point per element, all zero.
    snapshot.gauss_per_element = 1;
    snapshot.gauss_positions = {Vec2::Zero()};
    for (auto* each : {&snapshot.stress, &snapshot.strain})
        each->assign(elements, mechanics::Voigt::Zero());
    for (auto* each : {&snapshot.epsilon_q, &snapshot.epsilon_q_plastic})
        each->assign(elements, 0.0);
    snapshot.position_0 = std::move(mesh.nodes);
    snapshot.quads = std::move(mesh.quads);
    snapshot.region_of_element = std::move(mesh.region_of_element);
    return snapshot;
}

process::Outcome write_mesh(process::Session& session) {
    const scene::Scene& scene = session.scene();
    scene::fem_of(scene);  // throws if /fem is missing
    try {
        Mesh mesh =
            build_mesh(scene, session.settings().output, [&] { return session.stop_requested(); });
        const Quality quality = quality_of(mesh);
        session.result()["elements"] = mesh.quads.size();
        session.result()["nodes"] = mesh.nodes.size();
        session.result()["mesh"] = {{"smallest_angle", quality.smallest_angle},
                                    {"largest_aspect", quality.largest_aspect},
                                    {"least_jacobian", quality.least_jacobian},
                                    {"shortest_edge", quality.shortest_edge},
                                    {"longest_edge", quality.longest_edge}};
        exchange::write_mesh_snapshot(session.output(phases::files::snapshot_name(0.0)),
                                      snapshot_of(scene, std::move(mesh)), session.provenance());
    } catch (const MeshingStopped&) {
        return process::Outcome::stopped;
    }
    return process::Outcome::done;
}

}  // namespace

process::Phase mesh_phase() {
    return {.name = "fem_solver mesh",
            .purpose = "The mesh of a scene's FEM, before it runs",
            .inputs = {0, 0, "takes no input beside the scene"},
            .plan = [](const scene::Scene& scene) { return process::Plan{mesher_of(scene).line}; },
            .run = write_mesh};
}

}  // namespace breach::fem
