#include "mpm_solver/measure/energy.hpp"

namespace breach::mpm {

Energy energy_of(const Body& body) {
    const Points& points = body.points;
    Energy energy{.kinetic = body.tally.kinetic,
                  .plastic = body.tally.plastic,
                  .friction = body.tally.friction,
                  .viscous = body.tally.viscous,
                  .shaking = body.tally.shaking};
    for (const Zone& zone : body.zones) {
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            const mechanics::Voigt sigma{points.sxx[p], points.syy[p], points.szz[p],
                                         points.sxy[p]};
            energy.elastic +=
                points.V[p] * mechanics::elastic_energy_density(zone.elasticity, sigma);
            energy.gravitational -=
                points.m[p] * (body.gravity.x() * points.x[p] + body.gravity.y() * points.y[p]);
            if (body.water.is_there())
                energy.gravitational +=
                    points.displaced[p] * body.water.pressure({points.x[p], points.y[p]});
        }
    }
    return energy;
}

/// docs/reference/methods/mpm.md, *Energy*. Elastic energy is not released: it is on the other side
/// of the budget.
double released(const Energy& start, const Energy& now) {
    return start.kinetic + start.gravitational - now.gravitational + now.shaking - start.shaking;
}

double numerical_loss(const Energy& start, const Energy& now) {
    const double gone = start.kinetic - now.kinetic + start.gravitational - now.gravitational +
                        start.elastic - now.elastic + now.shaking - start.shaking;
    return gone - (now.plastic - start.plastic) - (now.friction - start.friction) -
           (now.viscous - start.viscous);
}

double kinetic_energy_of(const Points& points, const std::vector<std::uint8_t>& counts) {
    double energy = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!counts[points.region[p]]) continue;
        const double v_squared = points.vx[p] * points.vx[p] + points.vy[p] * points.vy[p];
        energy += 0.5 * points.m[p] * v_squared;
    }
    return energy;
}

double mass_of(const Points& points, const std::vector<std::uint8_t>& counts) {
    double mass = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (counts[points.region[p]]) mass += points.m[p];
    }
    return mass;
}

double mean_x_of(const Points& points, const std::vector<std::uint8_t>& counts) {
    double moment = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (counts[points.region[p]]) moment += points.m[p] * points.x[p];
    }
    const double mass = mass_of(points, counts);
    return mass > 0.0 ? moment / mass : 0.0;
}

double volume_of(const Points& points, const std::vector<std::uint8_t>& counts) {
    double volume = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (counts[points.region[p]]) volume += points.volume[p];
    }
    return volume;
}

}  // namespace breach::mpm
