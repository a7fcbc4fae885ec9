// Model and Motion include the free-field columns, a snapshot has the body alone: arrays are cut to
// its nodes and elements first, then absent elements are dropped.
#include "fem_solver/snapshot.hpp"

#include <algorithm>
#include <cstdio>

#include "fem_solver/model/pore_water.hpp"

namespace breach::fem {
namespace {

std::vector<Vec2> per_node(const Eigen::VectorXd& per_dof, std::size_t nodes) {
    std::vector<Vec2> result(nodes);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = per_dof.segment<2>(2 * static_cast<Eigen::Index>(i));
    }
    return result;
}

void add_instability(const Model& model, const Motion& motion, exchange::MeshSnapshot& s) {
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        const std::size_t begin = model.zones[z].first * model.points_per_element;
        const auto add = [&](const auto& law, const auto& points) {
            s.psi.resize(s.stress.size(), 0.0);
            s.instability_ratio.resize(s.stress.size(), 0.0);
            for (std::size_t i = 0; i < points.size() && begin + i < s.psi.size(); ++i) {
                const materials::Instability at = instability(law, points[i]);
                s.psi[begin + i] = at.psi;
                s.instability_ratio[begin + i] = at.ratio;
            }
        };
        materials::with_state(model.zones[z].law, motion.memory[z], add);
    }
}

/// Keeps the entries of present elements, `width` per element.
template <class Values>
void keep_present(const Model& model, std::size_t width, Values& values) {
    if (values.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!model.is_absent(i / width)) values[to++] = values[i];
    values.resize(to);
}

/// Removes absent elements.
void drop_absent(const Model& model, exchange::MeshSnapshot& s) {
    if (std::ranges::find(model.absent, 1) == model.absent.end()) return;
    keep_present(model, 1, s.quads);
    keep_present(model, 1, s.region_of_element);
    keep_present(model, 1, s.density);
    const std::size_t points = model.points_per_element;
    keep_present(model, points, s.stress);
    keep_present(model, points, s.strain);
    keep_present(model, points, s.epsilon_q);
    keep_present(model, points, s.epsilon_q_plastic);
    keep_present(model, points, s.r_u_max);
    keep_present(model, points, s.shear_strain_max);
    keep_present(model, points, s.psi);
    keep_present(model, points, s.instability_ratio);
}

}  // namespace

exchange::MeshSnapshot snapshot_of(const scene::Scene& scene, const Model& model,
                                   const Motion& motion, const Beginning& beginning,
                                   const Largest& largest, double time, std::int64_t step) {
    exchange::MeshSnapshot s;
    s.time = time;
    s.step = step;
    s.thickness = model.thickness;
    for (const scene::Region& region : scene.section.regions) {
        s.regions.push_back(region.name);
        s.materials_of_regions.push_back(scene.materials[region.material].name);
    }
    const auto [nodes, elements] = model.body;
    const Mesh& mesh = model.mesh;
    const auto first = [](const auto& all, std::size_t count) {
        return std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    };
    s.position_0 = first(mesh.nodes, nodes);
    s.displacement = per_node(motion.u, nodes);
    s.velocity = per_node(motion.v, nodes);
    s.acceleration = per_node(motion.a, nodes);
    s.nodal_mass = first(model.nodal_mass, nodes);
    // Negative pressures above the line only serve the interpolation of elements that it cuts.
    if (motion.p.size() > 0) s.pore_pressure = first(without_suction(model.water, motion.p), nodes);
    if (beginning.p.size() > 0) {
        s.pore_pressure_0 = first(without_suction(model.water, beginning.p), nodes);
        s.sigma_v0 = beginning.sigma_v0;
        s.excess_pressure_max = largest.excess_pressure;
        s.r_u_max = largest.r_u;
        s.shear_strain_max = largest.shear_strain;
    }
    // Empty before the first dynamic stage and in a scene without columns.
    s.base_motion = beginning.base_motion;
    s.quads = first(mesh.quads, elements);
    s.region_of_element = first(mesh.region_of_element, elements);
    for (const Zone& zone : model.zones)
        s.density.insert(s.density.end(), zone.count, zone.density);
    s.density.resize(elements);
    s.gauss_per_element = static_cast<decltype(s.gauss_per_element)>(model.points_per_element);
    if (model.points_per_element == 1) {
        s.gauss_positions = {Vec2::Zero()};
    } else {
        s.gauss_positions.assign(gauss_positions().begin(), gauss_positions().end());
    }
    const std::size_t points = elements * model.points_per_element;
    // The body's points come first: zones of columns follow after them.
    s.strain = first(motion.strain, points);
    for (std::size_t p = 0; p < points; ++p) {
        s.stress.push_back(motion.points[p].sigma);
        s.epsilon_q.push_back(mechanics::epsilon_q(motion.strain[p]));
        s.epsilon_q_plastic.push_back(motion.points[p].epsilon_q);
    }
    // A law without elastic range has no plastic strain: its total strain drives softening.
    for (const Zone& zone : model.zones) {
        if (materials::traits(zone.law).tells_plastic_strain) continue;
        const std::size_t begin = zone.first * model.points_per_element;
        const std::size_t end =
            std::min(points, (zone.first + zone.count) * model.points_per_element);
        for (std::size_t p = begin; p < end; ++p) s.epsilon_q_plastic[p] = s.epsilon_q[p];
    }
    add_instability(model, motion, s);
    // Last, as all arrays above are indexed by the whole body's elements. Nodes stay.
    drop_absent(model, s);
    return s;
}

}  // namespace breach::fem
