#include "fem_solver/absorbing_base.hpp"

#include <algorithm>

namespace breach::fem {

AbsorbingBase absorbing_base(const Model& model, double impedance, motion::Series velocity,
                             MotionAt at) {
    const Mesh& mesh = model.mesh;
    double lowest = mesh.nodes.front().y();
    for (const Vec2& x : mesh.nodes) lowest = std::min(lowest, x.y());
    const double tolerance = 1e-6 * quality_of(mesh).shortest_edge;
    const auto is_base = [&](std::int32_t node) {
        return mesh.nodes[node].y() <= lowest + tolerance;
    };
    AbsorbingBase base;
    base.dashpot = Eigen::VectorXd::Zero(model.dofs());
    for (const Quad& quad : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t a = quad[k], b = quad[(k + 1) % 4];
            if (!is_base(a) || !is_base(b)) continue;
            const double edge = (mesh.nodes[b] - mesh.nodes[a]).norm();
            const double c = 0.5 * impedance * edge * model.thickness;
            base.dashpot[2 * static_cast<Eigen::Index>(a)] += c;
            base.dashpot[2 * static_cast<Eigen::Index>(b)] += c;
        }
    }
    if (at == MotionAt::upgoing) {
        for (double& v : velocity.values) v *= 2.0;
    }
    base.outcrop = std::move(velocity);
    return base;
}

}  // namespace breach::fem
