#include <algorithm>
#include <cmath>

#include "mpm_solver/step.hpp"
#include "mpm_solver/turn.hpp"
#include "mpm_solver/viscosity.hpp"

namespace breach::mpm {

namespace {

using materials::Return;
using mechanics::Voigt;
using scene::AntiLocking;

constexpr double third = 1.0 / 3.0;

/// Volume strain that the soil opened in tension closes first; returns what is left for the law.
double close_gap(double& gap, double d_epsilon_v) {
    const double closing = std::clamp(-d_epsilon_v, 0.0, gap);
    gap -= closing;
    return d_epsilon_v + closing;
}

/// Strain increment of point p over dt with its volumetric part replaced by d_epsilon_v.
Voigt strain_increment(const Points& points, std::size_t p, double dt, double d_epsilon_v) {
    const double xx = points.Lxx[p] * dt;
    const double yy = points.Lyy[p] * dt;
    const double shift = (d_epsilon_v - xx - yy) * third;
    return {xx + shift, yy + shift, shift, (points.Lxy[p] + points.Lyx[p]) * dt};
}

/// sqrt(2/3 e:e) of a strain whose volumetric part is known [-].
double equivalent(const Voigt& d_epsilon, double d_epsilon_v) {
    const double xx = d_epsilon[0] - d_epsilon_v * third;
    const double yy = d_epsilon[1] - d_epsilon_v * third;
    const double zz = d_epsilon[2] - d_epsilon_v * third;
    const double e_e = xx * xx + yy * yy + zz * zz + 0.5 * d_epsilon[3] * d_epsilon[3];
    return std::sqrt(2.0 * third * e_e);
}

void follow(Points& points, std::size_t p, const materials::Update& update) {
    const Voigt& sigma = update.state.sigma;
    points.sxx[p] = sigma[0];
    points.syy[p] = sigma[1];
    points.szz[p] = sigma[2];
    points.sxy[p] = sigma[3];
    points.epsilon_q_plastic[p] = update.state.epsilon_q;
}

double mean_stress(const Points& points, std::size_t p) {
    return (points.sxx[p] + points.syy[p] + points.szz[p]) * third;
}

void turn_rates_to_averages(CellAverages& averages) {
    for (const std::int32_t cell : averages.filled) {
        averages.sums[cell].trD /= averages.sums[cell].V;
    }
}

/// The law at every point of the zone; adds to the tally what it dissipates.
template <AntiLocking anti_locking, Overlap overlap, class Law>
void integrate_zone(Body& body, const Zone& zone, CellAverages* averages, const Law& law,
                    double dt) {
    Points& points = body.points;
    constexpr bool opens = std::is_same_v<Law, materials::ReadyMohrCoulomb>;
    const bool closes_gaps = zone.volume_rule == VolumeRule::from_stress;
    double plastic_work = 0.0;
    double pushed_in = 0.0;
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        double d_epsilon_v = (points.Lxx[p] + points.Lyy[p]) * dt;
        if constexpr (anti_locking == AntiLocking::on) {
            d_epsilon_v = averages->sums[points.cell[p]].trD * dt;
        }
        // The law is told of a compression that the soil's points do not show.
        if constexpr (overlap == Overlap::corrected) {
            const double hidden = body.overlap_rate * points.excess[p] * dt;
            d_epsilon_v -= hidden;
            pushed_in -= points.V[p] * mean_stress(points, p) * hidden;
        }
        points.volume[p] *= 1.0 + d_epsilon_v;
        if (opens && closes_gaps) d_epsilon_v = close_gap(points.gap[p], d_epsilon_v);
        const Voigt d_epsilon = strain_increment(points, p, dt, d_epsilon_v);
        const Voigt sigma{points.sxx[p], points.syy[p], points.szz[p], points.sxy[p]};
        const double angle = 0.5 * (points.Lyx[p] - points.Lxy[p]) * dt;
        const materials::State old{turned(sigma, angle), points.epsilon_q_plastic[p]};

        const materials::Update update = materials::integrate(law, old, d_epsilon);
        follow(points, p, update);
        points.epsilon_q[p] += equivalent(d_epsilon, d_epsilon_v);
        if constexpr (opens) {
            if (update.kind == Return::elastic) continue;
            const Voigt& plastic = update.d_epsilon_plastic;
            plastic_work += points.V[p] * update.state.sigma.dot(plastic);
            if (update.kind == Return::apex || update.kind == Return::tension) {
                points.gap[p] += std::max(plastic[0] + plastic[1] + plastic[2], 0.0);
            }
        }
    }
    body.tally.plastic += plastic_work;
    body.tally.pushed_in += pushed_in;
}

void average_mean_stress(Points& points, const Zone& zone, CellAverages& averages) {
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        averages.sums[points.cell[p]].sigma_m += points.V[p] * mean_stress(points, p);
    }
    for (const std::int32_t cell : averages.filled) {
        averages.sums[cell].sigma_m /= averages.sums[cell].V;
    }
    for (std::size_t p = zone.begin; p < zone.end; ++p) {
        const double shift = averages.sums[points.cell[p]].sigma_m - mean_stress(points, p);
        points.sxx[p] += shift;
        points.syy[p] += shift;
        points.szz[p] += shift;
    }
}

void update_volumes(Points& points, Zone& zone) {
    const double per_K = 1.0 / zone.elasticity.bulk_modulus();
    double largest = 0.0;
    if (zone.volume_rule == VolumeRule::from_stress) {
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            points.V[p] = points.V_0[p] * (1.0 + mean_stress(points, p) * per_K);
            largest = std::max(largest, points.V[p] / points.m[p]);
        }
    } else {
        for (std::size_t p = zone.begin; p < zone.end; ++p) {
            points.V[p] = points.volume[p];
            largest = std::max(largest, points.V[p] / points.m[p]);
        }
    }
    zone.largest_specific_volume = largest;
}

}  // namespace

template <AntiLocking anti_locking, Overlap overlap>
void update_stress(Body& body, double dt) {
    for (std::size_t z = 0; z < body.zones.size(); ++z) {
        Zone& zone = body.zones[z];
        CellAverages* averages = nullptr;
        if constexpr (anti_locking == AntiLocking::on) {
            averages = &body.averages[z];
            turn_rates_to_averages(*averages);
        }
        if (zone.viscosity > 0.0) body.tally.viscous += viscous_work(body.points, zone, dt);
        std::visit(
            [&](const auto& law) {
                integrate_zone<anti_locking, overlap>(body, zone, averages, law, dt);
            },
            zone.law);
        if constexpr (anti_locking == AntiLocking::on) {
            average_mean_stress(body.points, zone, *averages);
        }
        update_volumes(body.points, zone);
    }
}

template void update_stress<AntiLocking::on, Overlap::left_alone>(Body&, double);
template void update_stress<AntiLocking::off, Overlap::left_alone>(Body&, double);
template void update_stress<AntiLocking::on, Overlap::corrected>(Body&, double);
template void update_stress<AntiLocking::off, Overlap::corrected>(Body&, double);

}  // namespace breach::mpm
