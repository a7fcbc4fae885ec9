// Elastic column in its first mode of vertical vibration: frequency, order of convergence in time
// step and mesh, energy.
#include <cmath>
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::vibration_test {
namespace {

using bench::expect_error;
using std::numbers::pi;

constexpr double H = 10.0, E = 20e6, nu = 0.3, rho = 2000.0, v_top = 1e-3;

double omega() { return 0.5 * pi / H * mechanics::Elasticity{E, nu}.wave_speed(rho); }

struct Vibration {
    double top;            ///< displacement of the top at the end [m]
    double energy_change;  ///< relative
};

/// First mode u = (v_top / omega) sin(pi y / 2H) sin(omega t), to time `end` in `steps` steps.
Vibration vibrate(int rows, int steps, double end, Newmark newmark) {
    const Model model = bench::model_of(
        bench::parse(bench::scene_of({.width = 1.0, .height = H, .rows = rows, .gravity = 0.0})));
    Seconds seconds;
    Newton newton(model, Solved::motion_and_pressure, {1e-10, 20}, Symmetry::symmetric, seconds);
    const auto laws = laws_for(model, scene::StageLaws::elastic);
    Motion motion = at_rest(model);
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        motion.v[static_cast<Eigen::Index>(2 * i + 1)] =
            v_top * std::sin(0.5 * pi * model.mesh.nodes[i].y() / H);
    }
    Motion trial = motion;
    Prediction prediction = prediction_for(model);
    settle_stresses(newton, laws, motion, trial);
    set_acceleration(newton, model, {}, 0.0, prediction, motion);
    const auto energy = [&] {
        return (model.mass.array() * motion.v.array().square()).sum() + motion.force.dot(motion.u);
    };
    const double at_start = energy();
    for (int n = 0; n < steps; ++n) {
        const double dt = end / steps;
        const auto outcome = dynamic_step(newton, model, laws, newmark, {}, dt, n * dt + dt, motion,
                                          prediction, trial);
        EXPECT_EQ(outcome.end, NewtonOutcome::End::converged);
        std::swap(motion, trial);
    }
    const auto top = static_cast<Eigen::Index>(2 * nearest_node(model.mesh, {0.0, H}) + 1);
    return {motion.u[top], energy() / at_start - 1.0};
}

constexpr Newmark average_acceleration{0.25, 0.5};

/// Observed order from three errors, each with half the spacing of the one before.
double order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(ElasticWave, ConvergesWithOrderTwoInTheTimeStep) {
    const double end = 2.2 * 2.0 * pi / omega();
    const double reference = vibrate(16, 4096, end, average_acceleration).top;
    double error[3];
    for (int k = 0; k < 3; ++k) {
        error[k] = std::abs(vibrate(16, 64 << k, end, average_acceleration).top - reference);
    }
    std::printf("    errors %.3e %.3e %.3e m: orders %.3f %.3f\n", error[0], error[1], error[2],
                order(error[0], error[1]), order(error[1], error[2]));
    expect_error("order in time: |order - 2|", std::abs(order(error[1], error[2]) - 2.0), 0.05);
}

TEST(ElasticWave, ConvergesWithOrderTwoInTheMesh) {
    const double end = 2.2 * 2.0 * pi / omega();
    const double exact = v_top / omega() * std::sin(omega() * end);
    double error[3];
    for (int k = 0; k < 3; ++k) {
        error[k] = std::abs(vibrate(4 << k, 2048, end, average_acceleration).top - exact);
    }
    std::printf("    errors %.3e %.3e %.3e m: orders %.3f %.3f\n", error[0], error[1], error[2],
                order(error[0], error[1]), order(error[1], error[2]));
    expect_error("order in space: |order - 2|", std::abs(order(error[1], error[2]) - 2.0), 0.05);
}

TEST(ElasticWave, HasTheFrequencyOfTheColumn) {
    // A quarter period after a whole number of periods the top is at its maximum; a period later
    // the phase error has grown to 2 pi n (error of the frequency), visible where the displacement
    // crosses zero.
    const int periods = 10;
    const double end = periods * 2.0 * pi / omega();
    const Vibration v = vibrate(64, 200 * periods, end, average_acceleration);
    const double phase = std::asin(v.top * omega() / v_top);
    // Lumped mass on 64 quads: (pi/128)^2/24 = 2.5e-5 low; 200 steps per period: (2 pi/200)^2/12
    // = 8.2e-5 low.
    expect_error("frequency, relative", std::abs(phase) / (2.0 * pi * periods), 1.3e-4);
    expect_error("energy change over 10 periods, relative", std::abs(v.energy_change), 1e-9);
}

TEST(ElasticWave, LosesEnergyOnlyWithNumericalDamping) {
    const double end = 10.0 * 2.0 * pi / omega();
    const double change = vibrate(16, 2000, end, {0.3025, 0.6}).energy_change;
    // Newmark's damping ratio is pi (gamma - 1/2) dt / T = 1.57e-3: exp(-2 x 2 pi 10 x 1.57e-3) - 1
    // = -0.179.
    std::printf("    gamma 0.6: energy change %.4f over 10 periods, theory -0.179\n", change);
    EXPECT_NEAR(change, -0.179, 0.005);
}

}  // namespace
}  // namespace breach::fem::vibration_test
