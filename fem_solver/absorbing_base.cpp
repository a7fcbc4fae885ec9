#include "fem_solver/absorbing_base.hpp"

#include <spdlog/spdlog.h>

#include <cmath>

#include "core/motion/read_motion.hpp"
#include "fem_solver/model.hpp"

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
            const double c = 0.5 * impedance * edge * model.thickness_of(e);
            base.dashpot[2 * static_cast<Eigen::Index>(a)] += c;
            base.dashpot[2 * static_cast<Eigen::Index>(b)] += c;
        }
    }
    if (at == scene::MotionAt::upgoing) {
        for (double& v : velocity.values) v *= 2.0;
    }
    base.outcrop = std::move(velocity);
    return base;
}

motion::Series base_velocity(const scene::BaseMotion& wanted) {
    const motion::Recording recording = motion::read_motion(wanted.file);
    const auto refuse = [](const std::string& pointer, const std::string& cause,
                           const std::string& remedy) -> motion::Series {
        throw fault::BadInput("scene", {{pointer, cause, remedy}});
    };
    if (recording.quantity == motion::Quantity::displacement) {
        return refuse("/fem/motion/file", "is a displacement",
                      "give the acceleration or the velocity of the same motion");
    }
    if (recording.quantity == motion::Quantity::velocity) {
        if (wanted.scale_to_pga_g) {
            return refuse("/fem/motion/scale_to_pga_g",
                          "scales an acceleration; this is a velocity",
                          "give the acceleration, or leave the scale out");
        }
        if (wanted.baseline == scene::Baseline::corrected) {
            return refuse("/fem/motion/baseline", "is corrected in an acceleration only",
                          "give the acceleration, or take it as recorded");
        }
        return recording.series;
    }
    motion::Series acceleration = recording.series;
    if (wanted.baseline == scene::Baseline::corrected) {
        acceleration = motion::base_corrected(std::move(acceleration));
    }
    if (wanted.scale_to_pga_g) {
        acceleration = motion::scaled_to_peak(std::move(acceleration),
                                              *wanted.scale_to_pga_g * motion::standard_gravity);
    }
    constexpr double much = 0.05;  // of the peak velocity
    const motion::Baseline left = motion::baseline(acceleration);
    if (left.velocity_share > much) {
        spdlog::warn(
            "motion: {:.2g} m/s are left at its end ({:.0f} % of its peak velocity); "
            "\"baseline\": \"corrected\" takes them off",
            left.last_velocity, 100.0 * left.velocity_share);
    }
    return motion::integral(acceleration);
}

}  // namespace breach::fem
