// A column under sudden self-weight, with the vibration damped by blending: sigma_yy = M ln J in
// equilibrium with rho_0 g (H - Y), Y undeformed height (uniaxial strain, logarithmic because the
// law is integrated in rate form).
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::self_weight_column_test {
namespace {

constexpr double H = 20.0;
constexpr double rho = 2000.0;
constexpr double g = 10.0;

scene::Scene column(double E) {
    scene::Scene scene = one_soil(elastic(E, 0.3), rho, rectangle(0, 0, 2, H), 1.0, 2.0, 24.0);
    scene.gravity = g;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->right = scene::Wall::roller;
    scene.mpm->blending_rate = 100.0;  // for a quasi-static result
    return scene;
}

/// L2 error of sigma_yy over the points, relative to rho g H; undeformed heights from the start.
double stress_error(const scene::Scene& scene) {
    Body body = filled_body(scene);
    const std::vector<double> Y = body.points.y;
    const double c = body.zones[0].elasticity.wave_speed(rho);
    advance(body, scene, 40.0 * 4.0 * H / c, [&](double) {
        // Damps the mean motion, which affine PIC does not.
        for (std::size_t p = 0; p < body.points.size(); ++p) {
            body.points.vx[p] *= 0.995;
            body.points.vy[p] *= 0.995;
        }
    });
    double squares = 0.0;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        const double exact = -rho * g * (H - Y[p]);
        squares += (body.points.syy[p] - exact) * (body.points.syy[p] - exact);
    }
    return std::sqrt(squares / static_cast<double>(body.points.size())) / (rho * g * H);
}

// 3 %: the cell-averaged mean stress is a step of rho g h / 2 within a cell (2.5 % of the base
// stress, rms about 0.7 %), and a boundary cell is resolved by two points.
TEST(SelfWeightColumn, StressIsTheOverburdenAtSmallStrain) {
    expect_error_within("gimp, E 50 MPa: sigma_yy L2", stress_error(column(50e6)), 0.03);
}
TEST(SelfWeightColumn, StressIsTheOverburdenAtLargeStrain) {
    expect_error_within("gimp, E 2 MPa (15 % strain): sigma_yy L2", stress_error(column(2e6)),
                        0.03);
}
}  // namespace
}  // namespace breach::mpm::test::self_weight_column_test
