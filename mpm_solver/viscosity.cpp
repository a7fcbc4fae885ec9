#include "mpm_solver/viscosity.hpp"

namespace breach::mpm {

double viscous_work(const Points& points, const Zone& zone, double dt) {
    double work = 0.0;
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        const double mean = (points.Lxx[p] + points.Lyy[p]) / 3.0;
        const double xx = points.Lxx[p] - mean;
        const double yy = points.Lyy[p] - mean;
        const double xy = 0.5 * (points.Lxy[p] + points.Lyx[p]);
        const double D_D = xx * xx + yy * yy + mean * mean + 2.0 * xy * xy;
        work += points.V[p] * D_D;
    }
    return 2.0 * zone.viscosity * work * dt;
}

double viscous_speed(const Zone& zone, double h) {
    return 16.0 / 3.0 * zone.viscosity * zone.largest_specific_volume / h;
}

}  // namespace breach::mpm
