// Two elastic discs collide and separate (Sulsky, Chen & Schreyer 1994): momentum stays zero,
// energy is nearly conserved.
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::two_discs_test {
namespace {

geometry::Polygon disc(const mechanics::Vec2& centre, double radius) {
    geometry::Polygon ring;
    for (int k = 0; k < 90; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 90.0;
        ring.push_back(centre + radius * mechanics::Vec2{std::cos(angle), std::sin(angle)});
    }
    return ring;
}

scene::Scene two_discs(double h) {
    scene::Scene scene =
        one_soil(elastic(1000.0, 0.3), 1000.0, disc({0.35, 0.35}, 0.2), h, 1.2, 1.2);
    scene.section.regions.push_back(
        {.name = "upper", .material = 0, .polygon = disc({0.85, 0.85}, 0.2)});
    scene.mpm->blending_rate = 0.0;
    scene.mpm->anti_locking = scene::AntiLocking::off;  // nu = 0.3 does not lock
    scene.mpm->cfl = 0.2;
    return scene;
}

void expect_rebound(const std::string& what, double h, double allowed) {
    const scene::Scene scene = two_discs(h);
    Body body = filled_body(scene, [](const mechanics::Vec2& x) {
        const double v = x.x() + x.y() < 1.2 ? 0.1 : -0.1;
        return mechanics::Vec2{v, v};
    });
    const double start = mechanical(energy_of(body));
    const double scale = std::abs(body.points.m[0]) * 0.1 * static_cast<double>(body.points.size());
    const double momentum_0 = momentum_of(body.points).norm();
    advance(body, scene, 3.0);
    const Energy end = energy_of(body);
    expect_error_within(what + ": momentum drift",
                        (momentum_of(body.points).norm() - momentum_0) / scale, 1e-12);
    expect_error_within(what + ": total energy at the end", mechanical(end) / start - 1.0, allowed);
    std::printf("    %s: kinetic energy recovered %.3f\n", what.c_str(), end.kinetic / start);
    EXPECT_GT(end.kinetic / start, 0.8);
}

// Free surfaces that share nodes exchange forces: the published runs, with cells of a quarter of
// the radius, lose a few per cent there; the loss decreases with the square of the cells.
TEST(TwoDiscs, KeepTheirEnergy) {
    expect_rebound("8 cells across", 0.05, 0.05);
    expect_rebound("16 cells across", 0.025, 0.05 / 4.0);
}

}  // namespace
}  // namespace breach::mpm::test::two_discs_test
