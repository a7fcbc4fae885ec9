#include "fem_solver/model/absorbing_base.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

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

motion::Recording applied_motion(const scene::BaseMotion& wanted) {
    motion::Recording motion = motion::read_motion(wanted.file);
    const auto refuse = [](const std::string& pointer, const std::string& cause,
                           const std::string& remedy) {
        throw fault::BadInput("scene", {{pointer, cause, remedy}});
    };
    if (motion.quantity == motion::Quantity::displacement) {
        refuse("/fem/motion/file", "is a displacement",
               "give the acceleration or the velocity of the same motion");
    }
    if (motion.quantity == motion::Quantity::velocity) {
        if (wanted.scale_to_pga_g) {
            refuse("/fem/motion/scale_to_pga_g", "scales an acceleration; this is a velocity",
                   "give the acceleration, or leave the scale out");
        }
        if (wanted.baseline == scene::Baseline::corrected) {
            refuse("/fem/motion/baseline", "is corrected in an acceleration only",
                   "give the acceleration, or take it as recorded");
        }
        return motion;
    }
    if (wanted.baseline == scene::Baseline::corrected) {
        motion.series = motion::base_corrected(std::move(motion.series));
    }
    if (wanted.scale_to_pga_g) {
        motion.series = motion::scaled_to_peak(std::move(motion.series),
                                               *wanted.scale_to_pga_g * motion::standard_gravity);
    }
    return motion;
}

MotionPeaks peaks_of(const motion::Recording& motion) {
    if (motion.quantity == motion::Quantity::acceleration) {
        return {motion::peak(motion.series), motion::peak(motion::integral(motion.series))};
    }
    const std::vector<double>& v = motion.series.values;
    double steepest = 0.0;
    for (std::size_t i = 1; i < v.size(); ++i) {
        steepest = std::max(steepest, std::abs(v[i] - v[i - 1]) / motion.series.dt);
    }
    return {steepest, motion::peak(motion.series)};
}

motion::Series base_velocity(const scene::BaseMotion& wanted) {
    const motion::Recording motion = applied_motion(wanted);
    if (motion.quantity == motion::Quantity::velocity) return motion.series;
    constexpr double much = 0.05;  // of the peak velocity
    const motion::Baseline left = motion::baseline(motion.series);
    if (left.velocity_share > much) {
        spdlog::warn(
            "motion: {:.2g} m/s are left at its end ({:.0f} % of its peak velocity); "
            "\"baseline\": \"corrected\" takes them off",
            left.last_velocity, 100.0 * left.velocity_share);
    }
    return motion::integral(motion.series);
}

}  // namespace breach::fem
