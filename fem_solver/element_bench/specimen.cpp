#include "fem_solver/element_bench/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breach::element_bench {

namespace pm4sand = materials::pm4sand;

Voigt stress(const Specimen& specimen) {
    if (const auto* plain = std::get_if<PlainPoint>(&specimen.point)) return plain->state.sigma;
    const auto& sand = std::get<SandPoint>(specimen.point);
    return pm4sand::stress(sand.law, sand.state);
}

double shear_modulus(const Specimen& specimen) {
    if (const auto* plain = std::get_if<PlainPoint>(&specimen.point)) {
        return std::visit([](const auto& law) { return law.elasticity.shear_modulus(); },
                          plain->law);
    }
    return std::get<SandPoint>(specimen.point).state.G;
}

namespace {

Ending strain_point(PlainPoint& point, const Voigt& d, pm4sand::Counts&) {
    if (!d.allFinite()) return Ending::failed;
    point.state =
        std::visit([&](const auto& law) { return materials::integrate(law, point.state, d).state; },
                   point.law);
    return Ending::done;
}

Ending strain_point(SandPoint& point, const Voigt& d, pm4sand::Counts& counts) {
    const auto update = pm4sand::integrate(point.law, point.state, d, point.options);
    counts = update.counts;
    point.state = update.state;
    return update.outcome == pm4sand::Outcome::done ? Ending::done : Ending::failed;
}

/// Strain increment of a boundary: the driven part and the strain that is free.
Voigt increment(Boundary boundary, double d, double free) {
    switch (boundary) {
        case Boundary::undrained_shear:
            return {0.0, 0.0, 0.0, d};
        case Boundary::drained_shear:
            return {0.0, free, 0.0, d};
        case Boundary::undrained_biaxial:
            return {d, -d, 0.0, 0.0};
        case Boundary::drained_biaxial:
            return {free, -d, 0.0, 0.0};
    }
    return Voigt::Zero();
}

/// Index of the stress that the boundary holds and whose strain is free, or -1.
int held_component(Boundary boundary) {
    if (boundary == Boundary::drained_shear) return 1;
    if (boundary == Boundary::drained_biaxial) return 0;
    return -1;
}

}  // namespace

Trial strained(const Specimen& specimen, const Voigt& d_epsilon) {
    Trial trial{specimen, Ending::done, {}};
    trial.outcome =
        std::visit([&](auto& point) { return strain_point(point, d_epsilon, trial.counts); },
                   trial.specimen.point);
    if (trial.outcome == Ending::failed) {
        trial.specimen = specimen;
        return trial;
    }
    trial.specimen.epsilon_v -= d_epsilon[0] + d_epsilon[1];
    trial.specimen.epsilon_yy -= d_epsilon[1];
    trial.specimen.gamma += d_epsilon[3];
    return trial;
}

double held_stress(const Specimen& specimen, Boundary boundary) {
    const int component = held_component(boundary);
    return component < 0 ? 0.0 : stress(specimen)[component];
}

double response(const Specimen& specimen, Boundary boundary) {
    const Voigt sigma = stress(specimen);
    const bool shears =
        boundary == Boundary::undrained_shear || boundary == Boundary::drained_shear;
    return shears ? sigma[3] : 0.5 * (sigma[0] - sigma[1]);
}

Trial driven(const Specimen& specimen, Boundary boundary, double d, double held) {
    const int component = held_component(boundary);
    if (component < 0) return strained(specimen, increment(boundary, d, 0.0));

    // Secant for the free strain, started with the constrained modulus; every trial starts from the
    // same specimen. The best trial counts: a scheme that projects at the end of a call may jump
    // over the held stress.
    constexpr int most_passes = 30;
    const double scale = std::max(std::abs(held), 1.0);
    const double stiffness = 4.0 * shear_modulus(specimen);
    pm4sand::Counts counts;
    Trial best;
    double least = std::numeric_limits<double>::infinity();
    double x0 = 0.0, f0 = 0.0, x = 0.0;
    for (int pass = 0; pass < most_passes && least > 1e-8 * scale; ++pass) {
        Trial trial = strained(specimen, increment(boundary, d, x));
        counts += trial.counts;
        if (trial.outcome == Ending::failed) break;
        const double f = stress(trial.specimen)[component] - held;
        if (std::abs(f) < least) {
            least = std::abs(f);
            best = std::move(trial);
        }
        const double slope = pass > 0 ? (f - f0) / (x - x0) : stiffness;
        x0 = x;
        f0 = f;
        x -= f / (std::isfinite(slope) && slope > 1e-4 * stiffness ? slope : stiffness);
    }
    if (least > 1e-4 * scale) best = {specimen, Ending::failed, {}};
    best.counts = counts;
    return best;
}

}  // namespace breach::element_bench
