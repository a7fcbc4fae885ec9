// Soil without contact falls freely, and soil without forces stays at rest.
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::free_fall_test {
namespace {

TEST(FreeFall, OfACloudIsExact) {
    scene::Scene scene =
        one_soil(sand(20e6, 0.3, 1e3, 30.0), 1800.0, rectangle(3, 12, 7, 18), 1.0, 10.0, 20.0);
    scene.gravity = 9.81;
    Body body = filled_body(scene);
    const double dt = 0.001;
    const int steps = 1000;
    const double from = centre_of_mass(body.points).y();
    for (int k = 0; k < steps; ++k) step(body, dt);
    // Symplectic Euler falls g dt^2 n (n + 1) / 2.
    const double exact = 9.81 * dt * dt * steps * (steps + 1) / 2.0;
    expect_error_within("fall of 4.9 m", (from - centre_of_mass(body.points).y()) / exact - 1.0,
                        1e-11);
    double stress = 0.0;
    for (const double s : body.points.syy) stress = std::max(stress, std::abs(s));
    expect_error_within("stress in free fall [Pa]", stress, 1e-6);
}

TEST(ZeroGravity, NothingMovesInAHundredSeconds) {
    scene::Scene scene =
        one_soil(sand(20e6, 0.3, 1e3, 30.0), 1800.0, rectangle(0, 0, 3, 3), 1.0, 6.0, 6.0);
    scene.mpm->cfl = 0.8;
    scene.mpm->left = scene::Wall::roller;
    Body body = filled_body(scene);
    const Points start = body.points;
    advance(body, scene, 100.0);
    double moved = 0.0;
    for (std::size_t p = 0; p < start.size(); ++p) {
        moved = std::max(moved,
                         std::hypot(body.points.x[p] - start.x[p], body.points.y[p] - start.y[p]));
    }
    expect_error_within("largest displacement [m]", moved, 0.0);
}

TEST(SingleParticle, FallsAndComesToRestOnTheFloor) {
    scene::Scene scene =
        one_soil(sand(20e6, 0.3, 1e3, 30.0), 1800.0, rectangle(2, 2, 3, 3), 1.0, 5.0, 5.0);
    scene.gravity = 9.81;
    scene.mpm->fill_points = 1;
    Body body = filled_body(scene);
    ASSERT_EQ(body.points.size(), 1U);
    advance(body, scene, 5.0);
    EXPECT_EQ(body.tally.lost, Tally::none);
    EXPECT_GT(body.points.y[0], 0.0);
    EXPECT_LT(body.points.y[0], 1.5);
    expect_error_within("sideways drift [m]", body.points.x[0] - 2.5, 1e-9);
}

}  // namespace
}  // namespace breach::mpm::test::free_fall_test
