// Two unknowns in two loops: for an inclination theta, F balances the forces (force_balance); theta
// is moved until the moment that is left over vanishes (outwards, balanced). The moment has no sign
// that is known beforehand, so the search starts at theta = 0 and goes to both sides.
#include "lem_tool/spencer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace breach::lem {

namespace {

/// A slice, mirrored so that the mass slides to the left.
struct Block {
    double sin_a;  ///< base inclination, positive if it falls in the sliding direction [-]
    double cos_a;  ///< [-]
    double V;      ///< vertical load [N/m]
    double H;      ///< horizontal load in the sliding direction [N/m]
    double H_dry;  ///< H without water [N/m]
    double r;      ///< lever arm of the shear about the centre, over R [-]
    double f;      ///< lever arm of the normal force, over R [-]
    double c_l;    ///< [N/m]
    double u_l;    ///< [N/m]
    double u_b;    ///< [N/m]
    double tan_phi;
    double normal;      ///< normal to the base, without interslice forces [N/m]
    double along;       ///< along the base, downwards [N/m]
    double resistance;  ///< c l + (normal - u l) tan phi [N/m]
};

struct Mass {
    std::vector<Block> blocks;
    double driving = 0.0;  ///< driving moment of all loads about the centre, over R [N/m]
};

Mass mass_of(const Slices& slices, const scene::Circle& circle, Slide slide, double k_h) {
    const double sense = slide == Slide::to_left ? 1.0 : -1.0;
    Mass mass;
    mass.blocks.reserve(slices.count);
    for (std::size_t i = 0; i < slices.count; ++i) {
        const double sin_a = sense * slices.sin_a[i];
        const double cos_a = slices.cos_a[i];
        double r = 1.0;
        double f = 0.0;
        double driving = sense * slices.driving[i] + k_h * slices.shaking[i];
        if (slices.stands_on[i] == Base::straight) {  // moment of the loads alone, see cut()
            const double d = sense * (slices.left[i] + 0.5 * slices.width[i] - circle.center.x()) /
                             circle.radius;
            const double h = (circle.center.y() - slices.base[i]) / circle.radius;
            r = d * sin_a + h * cos_a;
            f = d * cos_a - h * sin_a;
            driving += slices.weight[i] * (d - h * sin_a / cos_a);
        }
        mass.driving += driving;
        const double V = slices.weight[i];
        const double H = sense * slices.push[i] + k_h * slices.soil_weight[i];
        const double u_l = slices.u[i] * slices.length[i];
        const double c_l = slices.c[i] * slices.length[i];
        const double normal = V * cos_a - H * sin_a;
        mass.blocks.push_back({sin_a, cos_a, V, H, H - sense * slices.push[i], r, f, c_l, u_l,
                               slices.u[i] * slices.width[i], slices.tan_phi[i], normal,
                               V * sin_a + H * cos_a, c_l + (normal - u_l) * slices.tan_phi[i]});
    }
    return mass;
}

/// Direction of all interslice forces.
struct Direction {
    explicit Direction(double theta) : sine(std::sin(theta)), cosine(std::cos(theta)) {}
    double sine;
    double cosine;
    double cos_turn(const Block& b) const { return b.cos_a * cosine + b.sin_a * sine; }
    double sin_turn(const Block& b) const { return b.sin_a * cosine - b.cos_a * sine; }
};

/// Resultant of the interslice forces on a slice with the inclination theta, from equilibrium along
/// and normal to its base.
double resultant(const Block& b, double F, const Direction& theta) {
    return (F * b.along - b.resistance) / (F * theta.cos_turn(b) + theta.sin_turn(b) * b.tan_phi);
}

/// Sum of the resultants and its derivative by F.
struct Sum {
    double value = 0.0;
    double slope = 0.0;
};

Sum sum_of_resultants(const Mass& mass, double F, const Direction& theta) {
    Sum sum;
    for (const Block& b : mass.blocks) {
        const double turn = theta.cos_turn(b);
        const double inverse = 1.0 / (F * turn + theta.sin_turn(b) * b.tan_phi);
        const double Q = (F * b.along - b.resistance) * inverse;
        sum.value += Q;
        sum.slope += (b.along - Q * turn) * inverse;
    }
    return sum;
}

/// F for which the resultants sum to zero; the sum increases with F above the last pole.
std::optional<double> force_balance(const Mass& mass, const Direction& theta) {
    double low = 1e-6;
    for (const Block& b : mass.blocks) {
        const double cos_turn = theta.cos_turn(b);
        if (cos_turn <= 1e-3) return std::nullopt;
        low = std::max(low, -theta.sin_turn(b) / cos_turn * b.tan_phi * (1.0 + 1e-9));
    }
    double high = 2.0 * low + 1.0;
    // Beyond 1e6 the mass is not driven at this inclination.
    while (sum_of_resultants(mass, high, theta).value <= 0.0) {
        high *= 2.0;
        if (high > 1e6) return std::nullopt;
    }
    if (sum_of_resultants(mass, low * (1.0 + 1e-6), theta).value >= 0.0) return std::nullopt;
    double F = high;
    for (int n = 0; n < 200 && high - low > 1e-13 * high; ++n) {
        const Sum sum = sum_of_resultants(mass, F, theta);
        // Newton within a bracket: near the pole its steps leave the branch.
        (sum.value > 0.0 ? high : low) = F;
        const double newton = F - sum.value / sum.slope;
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - F) <= 1e-13 * F) return next;
        F = next;
    }
    return F;
}

/// Residual moment at force equilibrium.
struct Leftover {
    double theta;
    double F;
    double moment;  ///< about the centre over R [N/m]
};

std::optional<Leftover> leftover(const Mass& mass, double inclination) {
    const Direction theta(inclination);
    const auto F = force_balance(mass, theta);
    if (!F) return std::nullopt;
    Leftover left{inclination, *F, mass.driving};
    for (const Block& b : mass.blocks) {
        const double Q = resultant(b, *F, theta);
        const double S = b.along - Q * theta.cos_turn(b);
        const double N = b.normal + Q * theta.sin_turn(b);
        left.moment -= S * b.r + N * b.f;
    }
    return left;
}

/// The inclination with zero moment between two with opposite signs, by the Illinois method (false
/// position).
double balanced(const Mass& mass, double a, double at_a, double b, double at_b) {
    for (int n = 0; n < 60 && std::abs(b - a) > 1e-12; ++n) {
        const double theta = (a * at_b - b * at_a) / (at_b - at_a);
        const auto left = leftover(mass, theta);
        if (!left || left->moment == 0.0) return theta;
        if ((left->moment > 0.0) != (at_b > 0.0)) {
            a = b;
            at_a = at_b;
        } else {
            // The end that stays twice counts half (Illinois), or false position would creep from
            // one side.
            at_a *= 0.5;
        }
        if (std::abs(theta - b) <= 1e-12) return theta;
        b = theta;
        at_b = left->moment;
    }
    return b;
}

Spencer answer(const Mass& mass, const Leftover& balanced) {
    const Direction theta(balanced.theta);
    double m_alpha = 1.0;
    for (const Block& b : mass.blocks) {
        if (b.tan_phi == 0.0) continue;
        m_alpha = std::min(m_alpha, theta.cos_turn(b) + theta.sin_turn(b) * b.tan_phi / balanced.F);
    }
    return {balanced.F, balanced.theta, m_alpha};
}

/// Newton's method for both equations from a similar mass's answer. None if it leaves the branch
/// of that answer, or a base turns over.
std::optional<Leftover> beside(const Mass& mass, const Spencer& near) {
    constexpr double farthest = 0.1;  // [rad]; beyond it another root may be the nearest to level
    double F = near.factor_of_safety;
    double inclination = near.theta;
    for (int n = 0; n < 8; ++n) {
        const Direction theta(inclination);
        double force = 0.0, force_F = 0.0, force_theta = 0.0;
        double moment = mass.driving, moment_F = 0.0, moment_theta = 0.0;
        for (const Block& b : mass.blocks) {
            const double cosine = theta.cos_turn(b);
            const double sine = theta.sin_turn(b);
            const double divisor = F * cosine + sine * b.tan_phi;
            if (cosine <= 1e-3 || divisor <= 0.0) return std::nullopt;
            const double Q = (F * b.along - b.resistance) / divisor;
            const double Q_F = (b.along - Q * cosine) / divisor;
            const double Q_theta = -Q * (F * sine - cosine * b.tan_phi) / divisor;
            const double lever = cosine * b.r - sine * b.f;
            force += Q;
            force_F += Q_F;
            force_theta += Q_theta;
            moment += Q * lever - b.along * b.r - b.normal * b.f;
            moment_F += Q_F * lever;
            moment_theta += Q_theta * lever + Q * (sine * b.r + cosine * b.f);
        }
        const double determinant = force_F * moment_theta - force_theta * moment_F;
        const double d_F = (force_theta * moment - moment_theta * force) / determinant;
        const double d_theta = (moment_F * force - force_F * moment) / determinant;
        F += d_F;
        inclination += d_theta;
        if (!(F > 0.0) || !(std::abs(inclination - near.theta) < farthest)) return std::nullopt;
        if (std::abs(d_F) <= 1e-12 * F && std::abs(d_theta) <= 1e-12)
            return Leftover{inclination, F, moment};
    }
    return std::nullopt;
}

/// Searches from horizontal interslice forces outwards for equilibrium of both. Halves its steps
/// near inclinations at which bases turn over and F diverges.
std::optional<Leftover> outwards(const Mass& mass, const Leftover& level, double sense,
                                 Leftover& nearest) {
    constexpr double longest = 0.05;
    constexpr double shortest = 1e-4;
    // Forces that lift the mass (negative) are looked for less far than those that lean with the
    // slide.
    const double reach = sense > 0.0 ? 1.2 : 0.6;
    Leftover here = level;
    double step = longest;
    while (step >= shortest && std::abs(here.theta) < reach) {
        const auto next = leftover(mass, here.theta + sense * step);
        if (!next) {
            step *= 0.5;
            continue;
        }
        if ((here.moment > 0.0) != (next->moment > 0.0))
            return leftover(mass,
                            balanced(mass, here.theta, here.moment, next->theta, next->moment));
        here = *next;
        if (std::abs(here.moment) < std::abs(nearest.moment)) nearest = here;
    }
    return std::nullopt;
}

/// Between two steps the moment may cross zero twice: searches finer near the smallest.
std::optional<Leftover> between_steps(const Mass& mass, Leftover& nearest) {
    for (double step = 0.025; step > 1e-4; step *= 0.5) {
        const double center = nearest.theta;
        for (const double theta : {center - step, center + step}) {
            const auto next = leftover(mass, theta);
            if (!next) continue;
            if ((nearest.moment > 0.0) != (next->moment > 0.0))
                return leftover(
                    mass, balanced(mass, nearest.theta, nearest.moment, next->theta, next->moment));
            if (std::abs(next->moment) < std::abs(nearest.moment)) nearest = *next;
        }
    }
    return std::nullopt;
}

/// Whether the moment left over, between level forces and the inclination nearest to balance in a
/// similar mass's failure, is at least half of what it was there.
bool fails_alike(const Mass& mass, const Leftover& level, const Unbalanced& failure) {
    const double left = failure.moment_left;
    // Also false where no forces were in balance: such a failure is found at once.
    const auto as_far = [&](double moment) {
        return moment / mass.driving * left > 0.5 * left * left;
    };
    if (!as_far(level.moment)) return false;
    const auto there = leftover(mass, failure.theta);
    return there && as_far(there->moment);
}

}  // namespace

std::optional<Ordinary> ordinary(const Slices& slices, const scene::Circle& circle, Slide slide,
                                 double k_h) {
    const Mass mass = mass_of(slices, circle, slide, k_h);
    const auto factor = [&](const auto& effective_normal) -> std::optional<double> {
        double resisting = 0.0;
        double driving = mass.driving;
        for (const Block& b : mass.blocks) {
            const double N = effective_normal(b);
            resisting += (b.c_l + N * b.tan_phi) * b.r;
            driving -= (N + b.u_l) * b.f;
        }
        if (driving <= 0.0) return std::nullopt;
        return resisting / driving;
    };
    const auto F =
        factor([](const Block& b) { return (b.V - b.u_b) * b.cos_a - b.H_dry * b.sin_a; });
    const auto conventional = factor([](const Block& b) { return b.normal - b.u_l; });
    if (!F || !conventional) return std::nullopt;
    return Ordinary{*F, *conventional};
}

std::variant<Spencer, Unbalanced> spencer(const Slices& slices, const scene::Circle& circle,
                                          Slide slide, double k_h, const Similar& similar) {
    const Mass mass = mass_of(slices, circle, slide, k_h);
    if (similar.answer)
        if (const auto found = beside(mass, *similar.answer)) return answer(mass, *found);
    const bool frictionless =
        std::ranges::all_of(mass.blocks, [](const Block& b) { return b.tan_phi == 0.0; });
    const auto level = leftover(mass, 0.0);
    if (!level) return Unbalanced{0.0, 0.0, 0.0, frictionless};
    if (similar.failure && fails_alike(mass, *level, *similar.failure)) return *similar.failure;
    Leftover nearest = *level;
    // The solution nearest to horizontal interslice forces is the physical one.
    for (const double sense : {1.0, -1.0})
        if (const auto found = outwards(mass, *level, sense, nearest)) return answer(mass, *found);
    if (const auto found = between_steps(mass, nearest)) return answer(mass, *found);
    return Unbalanced{nearest.theta, nearest.F, nearest.moment / mass.driving, frictionless};
}

}  // namespace breach::lem
