#include "fem_solver/monitors/viscous_share.hpp"

#include <cmath>

namespace breach::fem {

namespace {

/// Diameter of Mohr's circle: largest engineering shear strain, or twice the largest shear stress.
double circle(double xx, double yy, double twice_xy) { return std::hypot(xx - yy, twice_xy); }

}  // namespace

double viscous_share(const Model& model, const Motion& motion, double threshold) {
    if (model.rayleigh.stiffness == 0.0) return 0.0;
    double viscous = 0.0, own = 0.0;
    for (const Zone& zone : model.zones) {
        const double eta =
            model.rayleigh.stiffness * materials::elasticity(zone.law).shear_modulus();
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            if (e >= model.body.elements || model.is_absent(e)) continue;
            const Dofs8 v = gather(model.mesh.quads[e], motion.v);
            for (std::size_t g = 0; g < model.points_per_element; ++g) {
                const std::size_t p = e * model.points_per_element + g;
                if (mechanics::epsilon_q(motion.strain[p]) <= threshold) continue;
                const Eigen::Vector3d rate = model.reference[e].B[g] * v;
                const double shear_rate = circle(rate[0], rate[1], rate[2]);
                const Voigt& sigma = motion.points[p].sigma;
                const double shear = 0.5 * circle(sigma[0], sigma[1], 2.0 * sigma[3]);
                // Weighted by rate: where a band does not shear any more, its damping is 0 and says
                // nothing.
                const double weight = shear_rate * model.volume[e];
                viscous += weight * eta * shear_rate;
                own += weight * shear;
            }
        }
    }
    return own > 0.0 ? viscous / own : 0.0;
}

}  // namespace breach::fem
