// Soil in standing water against closed forms: buoyancy, the thrust of a reservoir, and the runout
// of a submerged bank, which is that of its buoyant weight in a slower time.
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::standing_water_test {
namespace {

constexpr double g = 9.81;
constexpr double rho_w = 1000.0;

scene::Scene in_water(scene::Scene scene, std::vector<mechanics::Vec2> line) {
    scene.gravity = g;
    scene.mpm->water = {std::move(line), rho_w};
    return scene;
}

double fastest(const Points& points) {
    double most = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p)
        most = std::max(most, std::hypot(points.vx[p], points.vy[p]));
    return most;
}

TEST(StandingWater, HoldsABlockOfItsOwnDensityAtRest) {
    const scene::Scene scene = in_water(
        one_soil(elastic(1e6, 0.3), rho_w, rectangle(4, 2, 7, 5), 0.5, 12.0, 9.0), {{0.0, 8.0}});
    Body body = filled_body(scene);
    advance(body, scene, 2.0);
    expect_error_within("speed after 2 s over that of a free fall",
                        fastest(body.points) / (2.0 * g), 1e-11);
}

// The last step of 7 ms is whole: a relative error of dt / t.
TEST(StandingWater, LetsABlockSinkByItsBuoyantWeightAndFloatAtItsSurface) {
    const double rho = 1600.0;
    const scene::Scene scene = in_water(
        one_soil(elastic(1e6, 0.3), rho, rectangle(4, 6, 6, 8), 0.5, 12.0, 12.0), {{0.0, 10.0}});
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    const double from = centre_of_mass(body.points).y();
    advance(body, scene, 1.0);
    const double exact = 0.5 * (1.0 - rho_w / rho) * g;
    expect_error_within("sunk in 1 s", (from - centre_of_mass(body.points).y()) / exact - 1.0,
                        1e-2);
    expect_error_within("energy share", numerical_share(start, energy_of(body)), 1e-2);

    scene::Scene light = in_water(
        one_soil(elastic(1e6, 0.3), 500.0, rectangle(4, 4, 6, 6), 0.25, 12.0, 12.0), {{0.0, 5.0}});
    light.mpm->water->density = rho_w;
    Body afloat = filled_body(light);
    const double level = centre_of_mass(afloat.points).y();
    advance(afloat, light, 1.0);
    expect_error_within("move of a floating block over its draught",
                        centre_of_mass(afloat.points).y() - level, 0.01);
}

TEST(StandingWater, AcceleratesABlockDownAnInclineByItsBuoyantWeight) {
    const double theta = 20.0 * std::numbers::pi / 180.0, rho = 2000.0, t = 2.0;
    scene::Scene scene = one_soil(elastic(100e6, 0.3), rho, rectangle(2, 0, 6, 2), 0.5, 40.0, 5.0);
    scene.mpm->floor.friction = {{0.0, 40.0, 0.0}};
    // The floor is the incline: along it the water's pressure grows by rho_w g sin(theta). Its
    // gradient is that of a sloping line, times cos(theta).
    scene = in_water(scene, {{0.0, 5.0}, {40.0, 5.0 + 40.0 * std::tan(theta)}});
    scene.mpm->water->density = rho_w * std::cos(theta);
    Body body = filled_body(scene);
    body.gravity = g * mechanics::Vec2{std::sin(theta), -std::cos(theta)};
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.syy[p] = -(rho - rho_w) * g * std::cos(theta) * (2.0 - body.points.y[p]);
        body.points.szz[p] = 0.3 * body.points.syy[p];
    }
    const double from = centre_of_mass(body.points).x();
    advance(body, scene, t);
    const double exact = 0.5 * (1.0 - rho_w / rho) * g * std::sin(theta) * t * t;
    expect_error_within("20 degrees, no friction, 2 s",
                        (centre_of_mass(body.points).x() - from) / exact - 1.0, 0.01);
}

TEST(StandingWater, PushesADamWithTheThrustOfItsReservoir) {
    const double upstream = 8.0, downstream = 3.0;
    const scene::Scene scene =
        in_water(one_soil(elastic(1e6, 0.3), 2000.0, rectangle(4, 0, 16, 10), 0.5, 20.0, 12.0),
                 {{0.0, upstream}, {8.0, upstream}, {12.0, downstream}, {20.0, downstream}});
    const Body body = filled_body(scene);
    double thrust = 0.0;
    for (std::size_t p = 0; p < body.points.size(); ++p)
        thrust -= body.points.displaced[p] *
                  body.water.gradient({body.points.x[p], body.points.y[p]}).x();
    const double exact = 0.5 * rho_w * g * (upstream * upstream - downstream * downstream);
    expect_error_within("horizontal force", thrust / exact - 1.0, 1e-3);
}

// A submerged bank of phi = 0 is a bank of density rho - rho_w with the inertia of rho: the same
// motion, slower by sqrt(rho / (rho - rho_w)). The rates of the scheme are slowed alike.
TEST(StandingWater, LetsABankRunAsItsBuoyantWeightInSlowerTime) {
    const double rho = 1987.0, slower = std::sqrt(rho / (rho - rho_w)), end = 3.0;
    const auto bank = [](double density) {
        scene::Scene scene =
            one_soil(sand(2e6, 0.45, 6e3, 0.0), density, rectangle(0, 0, 10, 6), 0.5, 40.0, 12.0);
        scene.gravity = g;
        scene.mpm->left = scene::Wall::roller;
        scene.mpm->floor.friction = {};
        scene.mpm->fill_points = 3;
        return scene;
    };
    scene::Scene light = bank(rho - rho_w);
    scene::Scene wet = in_water(bank(rho), {{0.0, 11.0}});
    light.mpm->blending_rate = slower;  // 1 /s in the wet bank's time
    light.mpm->cfl = wet.mpm->cfl = 0.3;
    const auto front = [](const scene::Scene& scene, double time) {
        Body body = filled_body(scene);
        advance(body, scene, time);
        return runout_of(body.points, {1}, 10.0).all;
    };
    const double dry = front(light, end), sunk = front(wet, end * slower);
    std::printf("    toe advanced %.3f m and %.3f m\n", dry, sunk);
    EXPECT_GT(dry, 2.0);
    expect_error_within("runout beside the buoyant bank's", sunk / dry - 1.0, 1e-6);
}

}  // namespace
}  // namespace breach::mpm::test::standing_water_test
