// Terrain through square cells: blocks on slopes of every angle follow Coulomb friction, blocks on
// arcs of many short segments move like rigid bodies, a heap runs as on an aligned grid.
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::terrain_slope_test {
namespace {

using mechanics::Vec2;

constexpr double g = 9.81;
constexpr double rho = 2000.0;
constexpr double nu = 0.3;
constexpr double pi = std::numbers::pi;

/// Axes of a plane that dips to the right by theta.
struct Slope {
    double theta;
    Vec2 foot;
    Vec2 along() const { return {std::cos(theta), -std::sin(theta)}; }
    Vec2 normal() const { return {std::sin(theta), std::cos(theta)}; }
    Vec2 at(double s, double d) const { return foot + s * along() + d * normal(); }
};

constexpr double length = 4.0;
constexpr double height = 2.0;

/// A block on a plane through cells at any angle. 100 MPa: rho g H / M is 3e-4, so elastic
/// vibration does not matter.
scene::Scene block_on(const Slope& slope, double mu, double way) {
    const double h = 0.5;
    const double width = std::ceil((2.0 + (length + way) * std::cos(slope.theta) + height) / h) * h;
    const double drop = std::ceil(((length + way + 2.0) * std::sin(slope.theta) + 2.0) / h) * h;
    const geometry::Polygon block{slope.at(0, 0), slope.at(length, 0), slope.at(length, height),
                                  slope.at(0, height)};
    scene::Scene scene = one_soil(elastic(100e6, nu), rho, block, h, width, 20.0);
    scene.gravity = g;
    scene.mpm->domain_y = {-drop, 8.0};
    scene.mpm->floor = {.level = -drop, .friction = {{0.0, width, mu}}};
    scene.mpm->terrain = {slope.at(-3.0, 0.0), slope.at(length + way, 0.0)};
    return scene;
}

/// Its own weight as initial stress, so that it does not bounce.
void settle(Body& body, const Slope& slope) {
    const Vec2 n = slope.normal();
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const double d = n.dot(Vec2{body.points.x[p], body.points.y[p]} - slope.foot);
        const double s = -rho * g * std::cos(slope.theta) * (height - d);
        body.points.sxx[p] = s * n.x() * n.x();
        body.points.syy[p] = s * n.y() * n.y();
        body.points.sxy[p] = s * n.x() * n.y();
        body.points.szz[p] = nu * s;
    }
}

struct Slide {
    double along;   ///< [m]
    double normal;  ///< [m]
    double numerical;
};

Slide slide(const Slope& slope, double mu, double t, double way) {
    scene::Scene scene = block_on(slope, mu, way);
    Body body = filled_body(scene);
    settle(body, slope);
    const Energy start = energy_of(body);
    const Vec2 from = centre_of_mass(body.points);
    advance(body, scene, t);
    const Vec2 moved = centre_of_mass(body.points) - from;
    return {moved.dot(slope.along()), moved.dot(slope.normal()),
            numerical_share(start, energy_of(body))};
}

struct Case {
    double degrees;
    double mu;
    double t;
};

// Slide 1 %. Contact acts at nodes half a cell above the ground, so the block moves a few per cent
// of a cell higher than it was.
TEST(TerrainBlock, SlidesAsCoulombSaysOnEverySlope) {
    for (const Case& each :
         {Case{10, 0.1, 2.0}, Case{20, 0.2, 2.0}, Case{35, 0.4, 2.0}, Case{60, 0.5, 1.5}}) {
        const Slope slope{each.degrees * pi / 180.0, {2.3, 0.13}};
        const double a = g * (std::sin(slope.theta) - each.mu * std::cos(slope.theta));
        const double exact = 0.5 * a * each.t * each.t;
        const Slide reached = slide(slope, each.mu, each.t, exact + 1.0);
        const std::string what = std::to_string(static_cast<int>(each.degrees)) + " degrees, mu " +
                                 std::to_string(each.mu).substr(0, 3);
        expect_error_within(what, reached.along / exact - 1.0, 0.01);
        expect_error_within(what + ": drift off the slope / cell", reached.normal / 0.5, 0.10);
        expect_error_within(what + ": energy unaccounted for", reached.numerical, 0.02);
    }
}

// 20 mm: the shear of the block itself and some millimetres of creep.
TEST(TerrainBlock, SticksWhereFrictionHoldsIt) {
    const Slope slope{20.0 * pi / 180.0, {2.3, 0.13}};
    const Slide reached = slide(slope, 0.5, 3.0, 2.0);
    expect_error_within("20 degrees, mu 0.5, 3 s: creep [m]", reached.along, 0.02);
}

// ------------------------------------------------ arcs: a kink of one degree every half metre

constexpr double R = 30.0;
constexpr double thick = 1.5;

/// Points of a circle about `centre`; angle 0 points down (side = -1) or up (side = +1).
Vec2 on_arc(const Vec2& centre, double radius, double angle, double side) {
    return centre + radius * Vec2{std::sin(angle), side * std::cos(angle)};
}

/// A sector of a ring, `from` to `to`, that lies on the arc of radius R; side as above.
geometry::Polygon sector(const Vec2& centre, double from, double to, double side) {
    const double far = R + side * thick;
    geometry::Polygon ring;
    constexpr int parts = 12;
    for (int k = 0; k <= parts; ++k) {
        ring.push_back(on_arc(centre, R, from + (to - from) * k / parts, side));
    }
    for (int k = parts; k >= 0; --k) {
        ring.push_back(on_arc(centre, far, from + (to - from) * k / parts, side));
    }
    return ring;
}

/// Ground of one-degree edges whose vertices lie on the arc, 40 degrees to each side.
std::vector<Vec2> ground(const Vec2& centre, double side) {
    std::vector<Vec2> line;
    for (int k = -40; k <= 40; ++k) line.push_back(on_arc(centre, R, k * pi / 180.0, side));
    return line;
}

scene::Scene on_arc_scene(const Vec2& centre, double from, double to, double side) {
    const double h = 0.5;
    scene::Scene scene =
        one_soil(elastic(100e6, nu), rho, sector(centre, from, to, side), h, 48.0, 20.0);
    scene.gravity = g;
    scene.mpm->domain_y = {-2.0, 14.0};
    scene.mpm->floor = {.level = -2.0, .friction = {{0.0, 48.0, 0.0}}};
    scene.mpm->terrain = ground(centre, side);
    return scene;
}

/// theta'' = side g d / (I/m) sin(theta): the sector turns about the arc's centre as a rigid body.
double turned_after(double theta, double span, double side, double t) {
    const double far = R + side * thick;
    const double r3 = std::abs(far * far * far - R * R * R);
    const double r2 = std::abs(far * far - R * R);
    const double d = 2.0 / 3.0 * r3 / r2 * std::sin(0.5 * span) / (0.5 * span);
    const double inertia = 0.5 * (far * far + R * R);
    const auto a = [&](double angle) { return side * g * d / inertia * std::sin(angle); };
    double rate = 0.0;
    constexpr int steps = 20000;
    const double dt = t / steps;
    for (int k = 0; k < steps; ++k) {  // leapfrog
        rate += 0.5 * dt * a(theta);
        theta += dt * rate;
        rate += 0.5 * dt * a(theta);
    }
    return theta;
}

double angle_of(const Body& body, const Vec2& centre, double side) {
    const Vec2 from_centre = centre_of_mass(body.points) - centre;
    return std::atan2(from_centre.x(), side * from_centre.y());
}

void expect_rigid_turn(const std::string& what, const Vec2& centre, double middle, double side,
                       double t) {
    const double span = 6.0 * pi / 180.0;
    const scene::Scene scene = on_arc_scene(centre, middle - 0.5 * span, middle + 0.5 * span, side);
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    const double theta = angle_of(body, centre, side);
    advance(body, scene, t);
    const double exact = turned_after(theta, span, side, t) - theta;
    const double reached = angle_of(body, centre, side) - theta;
    std::printf("    %s: %.3f degrees of %.3f\n", what.c_str(), reached * 180.0 / pi,
                exact * 180.0 / pi);
    expect_error_within(what, reached / exact - 1.0, 0.01);
    const Energy end = energy_of(body);
    expect_error_within(what + ": kinetic energy / released",
                        end.kinetic / released(start, end) - 1.0, 0.03);
}

TEST(TerrainArc, BlockSwingsThroughAValleyAsAPendulum) {
    expect_rigid_turn("from -20 degrees, 3.5 s", {24.0, 30.3}, -20.0 * pi / 180.0, -1.0, 3.5);
}

// Unstable: the effect of the first contact grows, so it starts well away from the top.
TEST(TerrainArc, BlockSlipsOffAHilltopAsARigidBody) {
    expect_rigid_turn("from 10 degrees, 1.6 s", {24.0, -24.0}, 10.0 * pi / 180.0, 1.0, 2.5);
}

// ------------------------------------------- a released heap, against a grid along the slope

struct Spread {
    double half;
    double front;
};

Spread spread_of(const Body& body, const Slope& slope) {
    std::vector<std::pair<double, double>> places;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const Vec2 x{body.points.x[p], body.points.y[p]};
        places.emplace_back((x - slope.foot).dot(slope.along()), body.points.m[p]);
    }
    std::sort(places.begin(), places.end());
    return {percentile(places, 0.5), percentile(places, 0.99)};
}

TEST(TerrainHeap, RunsAsOnAGridThatFollowsTheSlope) {
    const double side = 4.0;
    const double mu = 0.3;
    const double t = 3.0;
    const materials::Law soil = sand(5e6, nu, 0.0, 30.0);
    const Slope level{0.0, {2.0, 0.0}};
    scene::Scene aligned = one_soil(soil, 1800.0, rectangle(2, 0, 2 + side, side), 0.5, 36.0, 6.0);
    aligned.mpm->floor.friction = {{0.0, 36.0, mu}};
    aligned.gravity = g;
    const double theta = 20.0 * pi / 180.0;
    Body straight = filled_body(aligned);
    straight.gravity = g * Vec2{std::sin(theta), -std::cos(theta)};
    advance(straight, aligned, t);

    const Slope slope{theta, {4.0, 0.0}};
    scene::Scene cut = one_soil(
        soil, 1800.0, {slope.at(0, 0), slope.at(side, 0), slope.at(side, side), slope.at(0, side)},
        0.5, 40.0, 20.0);
    cut.gravity = g;
    cut.mpm->domain_y = {-16.0, 6.0};
    cut.mpm->floor = {.level = -16.0, .friction = {{0.0, 40.0, mu}}};
    cut.mpm->terrain = {slope.at(-4.0, 0.0), slope.at(36.0, 0.0)};
    Body tilted = filled_body(cut);
    advance(tilted, cut, t);

    const Spread a = spread_of(straight, level);
    const Spread b = spread_of(tilted, slope);
    std::printf("    aligned: median %.2f m, 99th %.2f m; cut: %.2f m, %.2f m\n", a.half, a.front,
                b.half, b.front);
    expect_error_within("99th percentile", b.front / a.front - 1.0, 0.05);
    expect_error_within("median / 99th percentile", (b.half - a.half) / a.front, 0.05);
}

}  // namespace
}  // namespace breach::mpm::test::terrain_slope_test
