// Waves from below: a Ricker pulse through a layer over a half-space, and the factor between
// outcrop and up-going motion.
#include <cmath>
#include <numbers>

#include "fem_solver/coupled_step.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem {
namespace {

using bench::expect_error;
using nlohmann::json;
using std::numbers::pi;

constexpr double H = 20.0, V_s = 200.0, rho = 1900.0, V_rock = 760.0, rho_rock = 2400.0;
constexpr double dt = 1e-3, length = 3.0, f_0 = 2.0, amplitude = 0.1;

double ricker(double t) {
    const double a = std::pow(pi * f_0 * (t - 1.2 / f_0), 2);
    return amplitude * (1.0 - 2.0 * a) * std::exp(-a);
}

motion::Series ricker_series() {
    motion::Series v{dt, {}};
    for (int i = 0; i <= std::lround(length / dt); ++i) v.values.push_back(ricker(i * dt));
    return v;
}

/// A shear column: every u_y held, so left and right move alike without ties.
Model column() {
    const double G = rho * V_s * V_s, nu = 0.3;
    json scene = bench::scene_of(
        {.width = 1.0,
         .height = H,
         .rows = 20,
         .law = {{"type", "linear_elastic"}, {"E_MPa", 2.0 * G * (1 + nu) / 1e6}, {"nu", nu}},
         .density = rho,
         .gravity = 0.0});
    scene["fem"]["element"] = "ssp";
    Model model = bench::model_of(bench::parse(scene));
    model.unknowns.count = 0;
    for (std::size_t d = 0; d < model.unknowns.of_dof.size(); ++d) {
        model.unknowns.of_dof[d] = d % 2 == 0 ? model.unknowns.count++ : -1;
    }
    return model;
}

struct Histories {
    std::vector<double> surface, base;
};

Histories shake(MotionAt at, double impedance) {
    const Model model = column();
    const PoreWater dry{{}, std::vector<std::int32_t>(model.mesh.nodes.size(), -1), 0};
    const AbsorbingBase base = absorbing_base(model, impedance, ricker_series(), at);
    Seconds seconds;
    CoupledStep step(model, dry, base, {1e-10, 20}, seconds);
    CoupledMotion now = coupled_at_rest(model), trial = now;
    const auto laws = laws_for(model, scene::StageLaws::elastic);
    const auto top = static_cast<Eigen::Index>(2 * nearest_node(model.mesh, {0.0, H}));
    const auto bottom = static_cast<Eigen::Index>(2 * nearest_node(model.mesh, {0.0, 0.0}));
    Histories h{{0.0}, {0.0}};
    for (int n = 1; n <= std::lround(length / dt); ++n) {
        EXPECT_EQ(step.take(laws, {0.25, 0.5}, dt, n * dt, now, trial).end,
                  NewtonOutcome::End::converged);
        std::swap(now, trial);
        h.surface.push_back(now.solid.v[top]);
        h.base.push_back(now.solid.v[bottom]);
    }
    return h;
}

/// Exact: surface and base velocity of a layer over a half-space as sums of delayed pulses. With R
/// = (1 - a) / (1 + a), a = impedance ratio, an outcrop pulse v gives v_surface(t) = 2 / (1 + a)
/// sum R^n ... of both travel directions.
double exact_surface(double t, double a) {
    const double travel = H / V_s, T = 1.0 / (1.0 + a), R = (1.0 - a) / (1.0 + a);
    // The up-going wave v/2 is transmitted with 2/(1 + a), doubled at the surface, and comes back
    // from the base with -R (softer over stiffer).
    double v = 0.0, strength = 2.0 * T;
    for (int n = 0; n < 60; ++n, strength *= -R) v += strength * ricker(t - (2 * n + 1) * travel);
    return v;
}

double exact_base(double t, double a) {
    const double travel = H / V_s, T = 1.0 / (1.0 + a), R = (1.0 - a) / (1.0 + a);
    double v = T * ricker(t), strength = T * (1.0 - R);
    for (int n = 1; n < 60; ++n, strength *= -R) v += strength * ricker(t - 2 * n * travel);
    return v;
}

template <class Exact>
double relative_l2(const std::vector<double>& reached, Exact exact) {
    double difference = 0.0, norm = 0.0;
    for (std::size_t n = 0; n < reached.size(); ++n) {
        const double v = exact(dt * static_cast<double>(n));
        difference += (reached[n] - v) * (reached[n] - v);
        norm += v * v;
    }
    return std::sqrt(difference / norm);
}

TEST(RickerPulse, PassesALayerOverAHalfSpace) {
    const double impedance = rho_rock * V_rock, a = rho * V_s / impedance;
    const Histories h = shake(MotionAt::outcrop, impedance);
    // OpenSees on the same mesh and step: 1.7e-3 at the surface, 1.4e-3 at the base.
    expect_error("surface velocity, relative L2 against the exact transfer",
                 relative_l2(h.surface, [&](double t) { return exact_surface(t, a); }), 3e-3);
    expect_error("base velocity, relative L2 against the exact transfer",
                 relative_l2(h.base, [&](double t) { return exact_base(t, a); }), 3e-3);
}

TEST(RickerPulse, LeavesThroughABaseOfTheSameRock) {
    const Histories h = shake(MotionAt::outcrop, rho * V_s);
    expect_error("surface is the outcrop motion, H / V_s later",
                 relative_l2(h.surface, [](double t) { return ricker(t - H / V_s); }), 3e-3);
    const Histories twice = shake(MotionAt::upgoing, rho * V_s);
    double error = 0.0;
    for (std::size_t n = 0; n < h.surface.size(); ++n) {
        error = std::max(error, std::abs(twice.surface[n] - 2.0 * h.surface[n]));
    }
    expect_error("the same numbers as up-going motion: twice as much [m/s]", error, 1e-12);
}

}  // namespace
}  // namespace breach::fem
