// A block on a frictional floor, released at v0: it stops after v0^2 / (2 mu g). On an inclined
// floor (gravity turned) it accelerates by g (sin theta - mu cos theta).
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::sliding_block_test {
namespace {

constexpr double g = 9.81;

scene::Scene block(double E, double mu) {
    scene::Scene scene = one_soil(elastic(E, 0.3), 2000.0, rectangle(2, 0, 6, 2), 0.5, 40.0, 5.0);
    scene.gravity = g;
    scene.mpm->floor.friction = {{0.0, 40.0, mu}};
    return scene;
}

/// The block's own weight as initial stress, so that it does not bounce.
void settle(Body& body, double rho, double H, double nu) {
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const double syy = -rho * g * (H - body.points.y[p]);
        body.points.syy[p] = syy;
        body.points.szz[p] = nu * syy;
    }
}

double slide(const scene::Scene& scene, double v0, double end) {
    Body body = filled_body(scene, [&](const mechanics::Vec2&) { return mechanics::Vec2{v0, 0}; });
    settle(body, 2000.0, 2.0, 0.3);
    const double from = centre_of_mass(body.points).x();
    advance(body, scene, end);
    return centre_of_mass(body.points).x() - from;
}

// 1 %: rho g H / M is 3e-4 at 100 MPa, so elastic vibration does not matter; the block's rocking
// remains.
TEST(SlidingBlock, StopsWhereCoulombSaysItStops) {
    const double v0 = 5.0;
    const double mu = 0.3;
    const double exact = v0 * v0 / (2.0 * mu * g);
    const double stops = v0 / (mu * g);
    const double slid = slide(block(100e6, mu), v0, stops + 0.5);
    expect_error_within("stopping distance 4.25 m", slid / exact - 1.0, 0.01);
}

TEST(SlidingBlock, AcceleratesDownAnInclineAsCoulombSays) {
    const double theta = 20.0 * std::numbers::pi / 180.0;
    const double mu = 0.2;
    const scene::Scene scene = block(100e6, mu);
    Body body = filled_body(scene);
    body.gravity = g * mechanics::Vec2{std::sin(theta), -std::cos(theta)};
    settle(body, 2000.0 * std::cos(theta), 2.0, 0.3);
    const double from = centre_of_mass(body.points).x();
    const double t = 2.0;
    advance(body, scene, t);
    const double exact = 0.5 * g * (std::sin(theta) - mu * std::cos(theta)) * t * t;
    expect_error_within("20 degrees, mu 0.2, 2 s",
                        (centre_of_mass(body.points).x() - from) / exact - 1.0, 0.01);
}

/// Friction for which the block would have gone as far in t [-].
double effective_friction(double theta, double mu, double t, double damping_ratio) {
    scene::Scene scene = block(100e6, mu);
    scene.mpm->damping_ratio = damping_ratio;
    Body body = filled_body(scene);
    body.gravity = g * mechanics::Vec2{std::sin(theta), -std::cos(theta)};
    settle(body, 2000.0 * std::cos(theta), 2.0, 0.3);
    const double from = centre_of_mass(body.points).x();
    advance(body, scene, t);
    const double slid = centre_of_mass(body.points).x() - from;
    std::printf("    mu %.3f: %.4f m in %.0f s\n", mu, slid, t);
    return std::tan(theta) - 2.0 * slid / (t * t * g * std::cos(theta));
}

// tan 20 degrees = 0.364. Undamped, the block vibrates: intermittent contact has less friction, and
// with 0.38 it slides half a metre.
TEST(SlidingBlock, RestsWhereFrictionJustHoldsItWhenItsWavesAreDamped) {
    const double theta = 20.0 * std::numbers::pi / 180.0;
    const double critical = std::tan(theta);
    for (const double mu : {0.368, 0.38, 0.40})
        expect_error_within("effective friction at rest, of tan 20 degrees",
                            effective_friction(theta, mu, 3.0, 0.1) / critical - 1.0, 0.005);
    EXPECT_LT(effective_friction(theta, 0.38, 3.0, 0.0), 0.98 * critical) << "undamped it slides";
    for (const double mu : {0.30, 0.35})
        expect_error_within("effective friction when it slides",
                            effective_friction(theta, mu, 3.0, 0.1) / mu - 1.0, 0.01);
}

TEST(SlidingBlock, EnergyGoesIntoFriction) {
    const double v0 = 5.0;
    const scene::Scene scene = block(100e6, 0.3);
    Body body = filled_body(scene, [&](const mechanics::Vec2&) { return mechanics::Vec2{v0, 0}; });
    settle(body, 2000.0, 2.0, 0.3);
    const Energy start = energy_of(body);
    advance(body, scene, 2.2);
    const Energy end = energy_of(body);
    // The rest of the energy lifted the rocking block slightly (contact acts within the first
    // cell).
    expect_error_within("energy unaccounted for / kinetic energy",
                        numerical_loss(start, end) / start.kinetic, 0.01);
    expect_error_within("friction work / kinetic energy - 1", end.friction / start.kinetic - 1.0,
                        0.03);
}

// Stiff: mu = 10 holds a block that is pushed at 1 m/s within v0^2 / (2 mu g) = 5 mm, plus the
// shear of the block itself.
TEST(SlidingBlock, HoldsAtAFrictionOfTen) {
    const double slid = slide(block(100e6, 10.0), 1.0, 1.0);
    expect_error_within("slide [m]", slid, 0.05);
}

TEST(SlidingBlock, NeverSlowsDownWithoutFriction) {
    const double slid = slide(block(100e6, 0.0), 5.0, 2.0);
    expect_error_within("distance in 2 s", slid / 10.0 - 1.0, 1e-9);
}

}  // namespace
}  // namespace breach::mpm::test::sliding_block_test
