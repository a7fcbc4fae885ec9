#include "fem_solver/model/absorbing_base.hpp"

#include "core/check/applied_motion.hpp"

namespace breach::fem {

AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             scene::MotionAt at) {
    const Mesh& mesh = model.mesh;
    const std::vector<bool>& is_base = model.constraints.is_base;
    AbsorbingBase base;
    base.dashpot = Eigen::VectorXd::Zero(model.dofs());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t a = mesh.quads[e][k], b = mesh.quads[e][(k + 1) % 4];
            if (!is_base[a] || !is_base[b]) continue;
            const double edge = (mesh.nodes[b] - mesh.nodes[a]).norm();
            // Edges of free-field columns, too: thick columns have thick dashpots.
            const double c = 0.5 * impedance * edge * model.thickness_of(e);
            base.dashpot[2 * static_cast<Eigen::Index>(a)] += c;
            base.dashpot[2 * static_cast<Eigen::Index>(b)] += c;
        }
    }
    if (at == scene::MotionAt::upgoing) {
        // The free surface of rock doubles the up-going wave.
        for (double& v : velocity.values) v *= 2.0;
    }
    base.outcrop = std::move(velocity);
    return base;
}

motion::Series base_velocity(const scene::BaseMotion& wanted) {
    const motion::Recording motion = check::applied_motion(wanted);
    if (motion.quantity == motion::Quantity::velocity) return motion.series;
    // The base needs a velocity: its force is proportional to it.
    return motion::integral(motion.series);
}

}  // namespace breach::fem
