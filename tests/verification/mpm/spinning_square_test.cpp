// A free elastic square spins three turns: affine FLIP keeps its angular momentum, which plain PIC
// would lose.
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::spinning_square_test {
namespace {

/// About the centre of mass, without affine parts like m (h/2)^2/3: points are small [kg m2/s].
double angular_momentum(const Points& points) {
    const mechanics::Vec2 c = centre_of_mass(points);
    double sum = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        sum += points.m[p] *
               ((points.x[p] - c.x()) * points.vy[p] - (points.y[p] - c.y()) * points.vx[p]);
    }
    return sum;
}

void expect_spin(const std::string& what, double blending_rate, double allowed) {
    scene::Scene scene =
        one_soil(elastic(1e6, 0.3), 1000.0, rectangle(4, 4, 8, 8), 0.5, 12.0, 12.0);
    scene.mpm->blending_rate = blending_rate;
    scene.mpm->anti_locking = scene::AntiLocking::off;  // nu = 0.3 does not lock
    const double omega = 1.0;
    Body body = filled_body(scene, [&](const mechanics::Vec2& x) {
        return mechanics::Vec2{-omega * (x.y() - 6.0), omega * (x.x() - 6.0)};
    });
    const double start = angular_momentum(body.points);
    const double energy = mechanical(energy_of(body));
    advance(body, scene, 3.0 * 2.0 * std::numbers::pi / omega);
    expect_error_within(what + ": angular momentum after 3 turns",
                        angular_momentum(body.points) / start - 1.0, allowed);
    std::printf("    %s: energy kept %.4f\n", what.c_str(), mechanical(energy_of(body)) / energy);
    expect_error_within(what + ": drift of the centre / h",
                        (centre_of_mass(body.points) - mechanics::Vec2{6.0, 6.0}).norm() / 0.5,
                        1e-9);
}

TEST(SpinningSquare, KeepsItsAngularMomentum) { expect_spin("rate 0", 0.0, 0.005); }
TEST(SpinningSquare, KeepsItsAngularMomentumAtTheDefaultRate) {
    expect_spin("rate 1/s", 1.0, 0.02);
}

}  // namespace
}  // namespace breach::mpm::test::spinning_square_test
