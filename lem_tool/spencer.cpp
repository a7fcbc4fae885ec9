#include "lem_tool/spencer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace breach::lem {

namespace {

/// A slice turned so that the mass slides to the left.
struct Block {
    double alpha;  ///< base inclination, positive where the base falls with the slide [rad]
    double V;      ///< vertical load [N/m]
    double H;      ///< horizontal load towards the slide [N/m]
    double r;      ///< arm of the shear about the centre over R [-]
    double f;      ///< arm of the normal force over R [-]
    double c_l;    ///< [N/m]
    double u_l;    ///< [N/m]
    double tan_phi;
};

struct Mass {
    std::vector<Block> blocks;
    double driving = 0.0;  ///< moment of all loads about the centre over R [N/m]
};

Mass mass_of(const Slices& slices, const scene::Circle& circle, Slide slide, double k_h) {
    const double sense = slide == Slide::to_left ? 1.0 : -1.0;
    Mass mass;
    for (std::size_t i = 0; i < slices.count; ++i) {
        const double sin_a = sense * slices.sin_a[i];
        const double cos_a = slices.cos_a[i];
        double r = 1.0;
        double f = 0.0;
        double driving = sense * slices.driving[i] + k_h * slices.shaking[i];
        if (slices.lever[i] != 1.0) {  // on a floor: the loads' own moment, see cut()
            const double d = sense * (slices.left[i] + 0.5 * slices.width[i] - circle.center.x()) /
                             circle.radius;
            const double h = (circle.center.y() - slices.base[i]) / circle.radius;
            r = d * sin_a + h * cos_a;
            f = d * cos_a - h * sin_a;
            driving += slices.weight[i] * (d - h * sin_a / cos_a);
        }
        mass.driving += driving;
        mass.blocks.push_back({std::atan2(sin_a, cos_a), slices.weight[i],
                               sense * slices.push[i] + k_h * slices.soil_weight[i], r, f,
                               slices.c[i] * slices.length[i], slices.u[i] * slices.length[i],
                               slices.tan_phi[i]});
    }
    return mass;
}

/// Resultant of the interslice forces on a block, inclined by theta, for equilibrium along and
/// across its base.
double resultant(const Block& b, double F, double theta) {
    const double turn = b.alpha - theta;
    const double normal = b.V * std::cos(b.alpha) - b.H * std::sin(b.alpha);
    const double along = b.V * std::sin(b.alpha) + b.H * std::cos(b.alpha);
    return (along - (b.c_l + (normal - b.u_l) * b.tan_phi) / F) /
           (std::cos(turn) + std::sin(turn) * b.tan_phi / F);
}

double sum_of_resultants(const Mass& mass, double F, double theta) {
    double sum = 0.0;
    for (const Block& b : mass.blocks) sum += resultant(b, F, theta);
    return sum;
}

/// F at which the resultants sum to zero; the sum grows with F above the last pole.
std::optional<double> force_balance(const Mass& mass, double theta) {
    double low = 1e-6;
    for (const Block& b : mass.blocks) {
        const double turn = b.alpha - theta;
        if (std::cos(turn) <= 1e-3) return std::nullopt;
        low = std::max(low, -std::tan(turn) * b.tan_phi * (1.0 + 1e-9));
    }
    double high = 2.0 * low + 1.0;
    while (sum_of_resultants(mass, high, theta) <= 0.0) {
        high *= 2.0;
        if (high > 1e6) return std::nullopt;
    }
    if (sum_of_resultants(mass, low * (1.0 + 1e-6), theta) >= 0.0) return std::nullopt;
    for (int n = 0; n < 200 && high - low > 1e-13 * high; ++n) {
        const double F = 0.5 * (low + high);
        (sum_of_resultants(mass, F, theta) > 0.0 ? high : low) = F;
    }
    return 0.5 * (low + high);
}

/// Moment about the centre that is left over when the forces balance.
std::optional<double> moment_left(const Mass& mass, double theta) {
    const auto F = force_balance(mass, theta);
    if (!F) return std::nullopt;
    double left = mass.driving;
    for (const Block& b : mass.blocks) {
        const double Q = resultant(b, *F, theta);
        const double S =
            b.V * std::sin(b.alpha) + b.H * std::cos(b.alpha) - Q * std::cos(b.alpha - theta);
        const double N =
            b.V * std::cos(b.alpha) - b.H * std::sin(b.alpha) + Q * std::sin(b.alpha - theta);
        left -= S * b.r + N * b.f;
    }
    return left;
}

double bisected(const Mass& mass, double low, double high, double at_low) {
    for (int n = 0; n < 60 && high - low > 1e-13; ++n) {
        const double theta = 0.5 * (low + high);
        const auto left = moment_left(mass, theta);
        if (!left) break;
        (*left > 0.0) == (at_low > 0.0) ? low = theta : high = theta;
    }
    return 0.5 * (low + high);
}

}  // namespace

std::optional<double> ordinary(const Slices& slices, const scene::Circle& circle, Slide slide,
                               double k_h) {
    const Mass mass = mass_of(slices, circle, slide, k_h);
    double resisting = 0.0;
    double driving = mass.driving;
    for (const Block& b : mass.blocks) {
        const double N = b.V * std::cos(b.alpha) - b.H * std::sin(b.alpha);
        resisting += (b.c_l + (N - b.u_l) * b.tan_phi) * b.r;
        driving -= N * b.f;
    }
    if (driving <= 0.0) return std::nullopt;
    return resisting / driving;
}

std::optional<Spencer> spencer(const Slices& slices, const scene::Circle& circle, Slide slide,
                               double k_h) {
    constexpr double step = 0.05;
    const Mass mass = mass_of(slices, circle, slide, k_h);
    // outwards from level interslice forces: the solution nearest to them is the physical one
    for (const double sense : {1.0, -1.0}) {
        const double reach = sense > 0.0 ? 1.2 : 0.6;
        double theta = 0.0;
        auto left = moment_left(mass, theta);
        while (left && std::abs(theta) < reach) {
            const double next = theta + sense * step;
            const auto then = moment_left(mass, next);
            if (!then) break;
            if ((*left > 0.0) != (*then > 0.0)) {
                const double low = std::min(theta, next);
                const double found = bisected(mass, low, low + step, sense > 0.0 ? *left : *then);
                const auto F = force_balance(mass, found);
                if (!F) return std::nullopt;
                return Spencer{*F, found};
            }
            theta = next;
            left = then;
        }
    }
    return std::nullopt;
}

}  // namespace breach::lem
