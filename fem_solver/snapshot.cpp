#include "fem_solver/snapshot.hpp"

#include <cstdio>

namespace breach::fem {
namespace {

std::vector<Vec2> per_node(const Eigen::VectorXd& per_dof) {
    std::vector<Vec2> result(static_cast<std::size_t>(per_dof.size() / 2));
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = per_dof.segment<2>(2 * static_cast<Eigen::Index>(i));
    }
    return result;
}

}  // namespace

exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, const Model& model,
                                   const Motion& motion, double time, std::int64_t step) {
    exchange::MeshSnapshot s;
    s.time = time;
    s.step = step;
    s.thickness = model.thickness;
    for (const scene::Region& region : scene.section.regions) {
        s.regions.push_back(region.name);
        s.materials_of_regions.push_back(scene.materials[region.material].name);
    }
    s.position_0 = model.mesh.nodes;
    s.displacement = per_node(motion.u);
    s.velocity = per_node(motion.v);
    s.acceleration = per_node(motion.a);
    s.nodal_mass = model.nodal_mass;
    s.quads = model.mesh.quads;
    s.region_of_element = model.mesh.region_of_element;
    for (const Zone& zone : model.zones)
        s.density.insert(s.density.end(), zone.count, zone.density);
    s.gauss_per_element = static_cast<decltype(s.gauss_per_element)>(model.points_per_element);
    if (model.points_per_element == 1) {
        s.gauss_positions = {Vec2::Zero()};
    } else {
        s.gauss_positions.assign(gauss_positions().begin(), gauss_positions().end());
    }
    s.strain = motion.strain;
    for (std::size_t p = 0; p < motion.points.size(); ++p) {
        s.stress.push_back(motion.points[p].sigma);
        s.epsilon_q.push_back(mechanics::epsilon_q(motion.strain[p]));
        s.epsilon_q_plastic.push_back(motion.points[p].epsilon_q);
    }
    return s;
}

std::string snapshot_name(double time) {
    char name[64];
    std::snprintf(name, sizeof name, "snapshot_%.6f.vtkhdf", time);
    return name;
}

}  // namespace breach::fem
