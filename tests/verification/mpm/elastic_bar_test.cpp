// A bar with one end at a wall vibrates in its first axial mode: v = v0 sin(pi x / 2 L) at t = 0,
// period 4 L / c. Without friction and plasticity its energy is conserved.
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::elastic_bar_test {
namespace {

constexpr double L = 25.0;
constexpr double E = 100.0;
constexpr double rho = 1.0;
constexpr double v0 = 0.1;

scene::Scene bar(double cfl) {
    scene::Scene scene = one_soil(elastic(E, 0.0), rho, rectangle(0, 0, L, 1), 1.0, 30.0, 3.0);
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->cfl = cfl;
    scene.mpm->blending_rate =
        0.0;  // the rate is intended dissipation; this tests the scheme itself
    return scene;
}

struct Swing {
    double energy_error;  ///< relative, at the end
    double
        velocity_error;  ///< rms of the centre of mass over all periods, relative to its amplitude
};

Swing ten_periods(const scene::Scene& scene) {
    const auto mode = [](const mechanics::Vec2& x) {
        return mechanics::Vec2{v0 * std::sin(std::numbers::pi * x.x() / (2.0 * L)), 0.0};
    };
    Body body = filled_body(scene, mode);
    const double c = std::sqrt(E / rho);
    const double omega = std::numbers::pi * c / (2.0 * L);
    const double start = mechanical(energy_of(body));
    const double amplitude = momentum_of(body.points).x();
    double squares = 0.0;
    int count = 0;
    advance(body, scene, 10.0 * 4.0 * L / c, [&](double t) {
        const double off = momentum_of(body.points).x() / amplitude - std::cos(omega * t);
        squares += off * off;
        ++count;
    });
    return {mechanical(energy_of(body)) / start - 1.0, std::sqrt(squares / count)};
}

// Velocity: the period of a bar of 25 cells with a free end on a node is off by a part of h / L = 4
// %, which adds up over 10 periods; 5 % rms is a quarter of a per cent of the period.
TEST(ElasticBar, KeepsItsEnergy) {
    const Swing swing = ten_periods(bar(0.1));
    expect_error_within("energy after 10 periods", swing.energy_error, 0.01);
    expect_error_within("rms of the mean velocity", swing.velocity_error, 0.05);
}

TEST(ElasticBar, LosesEnergyAtTheBlendingRateInAnyStep) {
    // The first mode is smooth, so affine PIC hardly differs from FLIP: a rate of 1/s must cost
    // little, at any step.
    double loss[2];
    int k = 0;
    for (const double cfl : {0.1, 0.4}) {
        scene::Scene scene = bar(cfl);
        scene.mpm->blending_rate = 1.0;
        loss[k++] = -ten_periods(scene).energy_error;
    }
    std::printf("    energy lost over 100 s at rate 1/s: CFL 0.1 %.4f, CFL 0.4 %.4f\n", loss[0],
                loss[1]);
    expect_error_within("difference between CFL 0.1 and 0.4", loss[0] - loss[1], 0.05);
}

}  // namespace
}  // namespace breach::mpm::test::elastic_bar_test
