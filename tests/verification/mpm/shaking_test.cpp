// A grid that moves with the ground: Newmark's sliding block on a plane and a slope, a column on a
// fixed base under a Ricker pulse, gravity as an accelerated frame, and the energy balance.
#include "mpm_solver/body/ground_motion.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::shaking_test {
namespace {

using mechanics::Vec2;

constexpr double g = 9.81;
constexpr double rho = 2000.0;
constexpr double pi = std::numbers::pi;

GroundMotion sampled(double dt, double end, const std::function<double(double)>& velocity) {
    exchange::BaseMotion base{.time_step = dt, .velocity = {}};
    const auto samples = static_cast<int>(std::lround(end / dt));
    for (int k = 0; k <= samples; ++k) base.velocity.push_back(velocity(k * dt));
    return {base, 0.0};
}

void shake(Body& body, const scene::Scene& scene, const GroundMotion& ground, double end,
           const std::function<void(double)>& each = {}) {
    for (double time = 0.0; time < end * (1.0 - 1e-12);) {
        const double dt = std::min(courant_step(body, scene.mpm->cfl), end - time);
        body.frame_acceleration = ground.acceleration(time, dt);
        step(body, dt);
        if (body.tally.lost != Tally::none) throw std::runtime_error("a point left the grid");
        time += dt;
        if (each) each(time);
    }
}

constexpr double length = 8.0, height = 1.0;  ///< flat: a tall block rocks, and rides on its edges

/// 100 MPa: rho g H / M is 1.5e-4, so elastic vibration does not matter.
scene::Scene block_on_plane(double mu) {
    scene::Scene scene =
        one_soil(elastic(100e6, 0.3), rho, rectangle(10, 0, 10 + length, height), 0.5, 30.0, 5.0);
    scene.gravity = g;
    scene.mpm->floor.friction = {{0.0, 30.0, mu}};
    return scene;
}

void settle(Body& body) {
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.syy[p] = -rho * g * (height - body.points.y[p]);
        body.points.szz[p] = 0.3 * body.points.syy[p];
    }
}

// Ground that gains V within V / A slips V^2 / (2 mu g) (1 - mu g / A) relative to the block
// (Newmark 1965). 1 %: half a per cent of the floor's friction, which counts twice in the slip.
TEST(ShakenBlock, SlipsWhatNewmarkSaysUnderARectangularPulse) {
    const double mu = 0.3, A = 6.0, V = 3.0;
    const double exact = -V * V / (2.0 * mu * g) * (1.0 - mu * g / A);
    const GroundMotion ground = sampled(0.05, V / A, [&](double t) { return A * t; });
    const scene::Scene scene = block_on_plane(mu);
    Body body = filled_body(scene);
    settle(body);
    const double from = centre_of_mass(body.points).x();
    shake(body, scene, ground, 2.0);
    const double slid = centre_of_mass(body.points).x() - from;
    expect_error_within("slip of 0.78 m", slid / exact - 1.0, 0.01);
    expect_error_within("velocity left [m/s]",
                        momentum_of(body.points).x() / (rho * length * height), 2e-3);
}

/// A rigid block on a plane that dips by theta to the right, shaken horizontally: slip down the
/// slope [m].
double newmark_slip(double theta, double mu, double end,
                    const std::function<double(double)>& acceleration) {
    const int steps = 200000;
    const double dt = end / steps;
    double v = 0.0, s = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double a = acceleration((k + 0.5) * dt);
        const double drive = g * std::sin(theta) - a * std::cos(theta);
        const double grip = mu * std::max(0.0, g * std::cos(theta) + a * std::sin(theta)) * dt;
        const double free = v + drive * dt;
        const double next = std::copysign(std::max(std::abs(free) - grip, 0.0), free);
        s += 0.5 * (v + next) * dt;
        v = next;
    }
    return s;
}

// Six cycles of 0.25 g at 1 Hz on 10 degrees: with mu 0.3 it yields downwards only. The slip of the
// cycles adds up. So near the yield acceleration, slip is nearly five times as sensitive to
// friction, and the floor's friction is accurate to 1 % (TerrainSlope): the limit is the slip with
// 1.2 % less friction.
TEST(ShakenBlock, WalksDownASlopeAsNewmarkSays) {
    const double theta = 10.0 * pi / 180.0, mu = 0.3, omega = 2.0 * pi, A = 0.25 * g, end = 6.0;
    const Vec2 foot{2.0, 0.0}, along{std::cos(theta), -std::sin(theta)},
        normal{std::sin(theta), std::cos(theta)};
    const auto at = [&](double s, double d) -> Vec2 { return foot + s * along + d * normal; };
    const double exact = newmark_slip(
        theta, mu, end + 1.0, [&](double t) { return t < end ? A * std::sin(omega * t) : 0.0; });
    const double smoother = newmark_slip(theta, 0.988 * mu, end + 1.0, [&](double t) {
        return t < end ? A * std::sin(omega * t) : 0.0;
    });
    const GroundMotion ground =
        sampled(0.002, end, [&](double t) { return A / omega * (1.0 - std::cos(omega * t)); });
    scene::Scene scene =
        one_soil(elastic(100e6, 0.3), rho,
                 {at(0, 0), at(length, 0), at(length, height), at(0, height)}, 0.5, 20.0, 20.0);
    scene.gravity = g;
    scene.mpm->domain_y = {-4.0, 8.0};
    scene.mpm->floor = {.level = -4.0, .friction = {{0.0, 20.0, mu}}};
    scene.mpm->terrain = {at(-2.0, 0.0), at(17.0, 0.0)};
    Body body = filled_body(scene);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const double d = normal.dot(Vec2{body.points.x[p], body.points.y[p]} - foot);
        const double s = -rho * g * std::cos(theta) * (height - d);
        body.points.sxx[p] = s * normal.x() * normal.x();
        body.points.syy[p] = s * normal.y() * normal.y();
        body.points.sxy[p] = s * normal.x() * normal.y();
        body.points.szz[p] = 0.3 * s;
    }
    const Vec2 from = centre_of_mass(body.points);
    shake(body, scene, ground, end + 1.0);
    const double slid = (centre_of_mass(body.points) - from).dot(along);
    std::printf("    a rigid block slips %.4f m, this one %.4f m\n", exact, slid);
    expect_error_within("slip down 10 degrees in 6 cycles", slid / exact - 1.0,
                        smoother / exact - 1.0);
}

// A column on a fixed base whose surface gets twice the base's pulse after H / c, and then its
// images: v(t) = 2 sum (-1)^n v_b(t - (2n + 1) H / c). Rollers beside a vertical column would hold
// it, so it is horizontal with its foot at the wall: the equation is the same.
TEST(ShakenColumn, AnswersARickerPulseAsAFixedBaseSays) {
    const double H = 20.0, c = 200.0, f = 1.5, amplitude = 0.1, end = 2.5;
    const auto pulse = [&](double t) {
        const double a = std::pow(pi * f * (t - 1.2 / f), 2);
        return amplitude * (1.0 - 2.0 * a) * std::exp(-a);
    };
    scene::Scene scene =
        one_soil(elastic(rho * c * c, 0.0), rho, rectangle(0, 0, H, 0.5), 0.25, 22.0, 1.0);
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->blending_rate = 0.0;
    scene.mpm->cfl = 0.2;
    Body body = filled_body(scene);
    std::size_t tip = 0;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        if (body.points.x[p] > body.points.x[tip]) tip = p;
    }
    const std::int32_t number = body.points.number[tip];
    const GroundMotion ground = sampled(0.001, end, pulse);
    double difference = 0.0, norm = 0.0;
    shake(body, scene, ground, end, [&](double t) {
        const auto p = std::ranges::find(body.points.number, number) - body.points.number.begin();
        double exact = -ground.velocity(t);
        for (int n = 0; n < 30; ++n)
            exact += (n % 2 == 0 ? 2.0 : -2.0) * pulse(t - (2 * n + 1) * H / c);
        difference += (body.points.vx[p] - exact) * (body.points.vx[p] - exact);
        norm += exact * exact;
    });
    expect_error_within("velocity of the surface on the ground, relative L2",
                        std::sqrt(difference / norm), 2e-3);
}

// A steadily accelerated frame is an inclined gravity: the same motion and energy.
TEST(ShakenBlock, ASteadyAccelerationIsATurnedGravity) {
    const double a = 5.0, end = 0.5;
    scene::Scene scene = block_on_plane(0.3);
    Body turned = filled_body(scene), shaken = filled_body(scene);
    settle(turned), settle(shaken);
    turned.gravity.x() = -a;
    advance(turned, scene, end);
    shake(shaken, scene, sampled(0.5, 1.0, [&](double t) { return a * t; }), end);
    const Vec2 apart = centre_of_mass(turned.points) - centre_of_mass(shaken.points);
    expect_error_within("centre of mass [m]", apart.norm(), 1e-10);
    expect_error_within("kinetic energy", shaken.tally.kinetic / turned.tally.kinetic - 1.0, 1e-9);
    // Gravity's work uses the velocity at the end of each step, the frame's the mean: half a step
    // apart.
    const double potential =
        a * rho * length * height * (10.0 + 0.5 * length - centre_of_mass(shaken.points).x());
    expect_error_within("work over the fall in the turned gravity",
                        shaken.tally.shaking / potential - 1.0, 0.01);
}

// Without dissipation the work of the frame's force equals the block's kinetic energy to round-off;
// with friction, the rest is the work of friction.
TEST(ShakenBlock, KeepsTheLedger) {
    const double omega = 2.0 * pi, A = 4.0;
    const GroundMotion ground =
        sampled(0.002, 5.0, [&](double t) { return A / omega * (1.0 - std::cos(omega * t)); });
    scene::Scene smooth = block_on_plane(0.0);
    smooth.gravity = 0.0;
    Body free = filled_body(smooth);
    double most = 0.0;
    shake(free, smooth, ground, 3.25, [&](double) { most = std::max(most, free.tally.kinetic); });
    expect_error_within("free block: kinetic energy less work, over the peak",
                        (free.tally.kinetic - free.tally.shaking) / most, 1e-9);

    const scene::Scene rough = block_on_plane(0.3);
    Body body = filled_body(rough);
    settle(body);
    const Energy start = energy_of(body);
    shake(body, rough, ground, 5.0);
    const Energy end = energy_of(body);
    std::printf("    the shaking put in %.5g J, friction took %.5g J\n", end.shaking, end.friction);
    expect_error_within("rough block: unaccounted for, over the work",
                        numerical_loss(start, end) / end.shaking, 0.01);
}

TEST(Ground, IsReadBetweenItsSamplesAndRestsAfterThem) {
    const GroundMotion ground({.time_step = 0.5, .velocity = {0.0, 1.0, 1.0, 0.0}}, 0.25);
    EXPECT_DOUBLE_EQ(ground.velocity(0.0), 0.5);
    EXPECT_DOUBLE_EQ(ground.acceleration(0.0, 0.25), 2.0);
    EXPECT_DOUBLE_EQ(ground.acceleration(0.0, 0.5), 1.0);
    EXPECT_DOUBLE_EQ(ground.acceleration(1.25, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(ground.end(), 1.25);
    EXPECT_DOUBLE_EQ(ground.displacement(0.0), 0.0625);
    EXPECT_DOUBLE_EQ(ground.displacement(0.125), 0.375 * 0.375);
    EXPECT_DOUBLE_EQ(ground.displacement(1.25), 0.25 + 0.5 + 0.25);
    EXPECT_DOUBLE_EQ(ground.displacement(2.25), 1.0);
    EXPECT_DOUBLE_EQ(ground.peak_acceleration(), 2.0);
    EXPECT_DOUBLE_EQ(ground.largest_swing(), 0.5);
    const GroundMotion over({.time_step = 0.5, .velocity = {0.0, 1.0, 0.0}}, 3.0);
    EXPECT_LT(over.end(), 0.0);
    EXPECT_DOUBLE_EQ(over.acceleration(0.0, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(over.largest_swing(), 0.0);
    EXPECT_DOUBLE_EQ(over.displacement(2.0), 0.5);
}

}  // namespace
}  // namespace breach::mpm::test::shaking_test
