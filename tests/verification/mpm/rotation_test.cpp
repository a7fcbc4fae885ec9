// Stress rotates with the material: after 90 degrees sigma_xx and sigma_yy are exchanged. (360
// degrees would not detect a missing rotation.)
#include "mpm_solver/loops/turn.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::rotation_test {
namespace {

mechanics::Voigt turned_voigt(const mechanics::Voigt& sigma, double angle) {
    const InPlane<double> t = turned<double>({sigma[0], sigma[1], sigma[3]}, angle);
    return {t.xx, t.yy, sigma[2], t.xy};
}

TEST(StressRotation, By90DegreesIsExact) {
    const mechanics::Voigt start{-100.0, -30.0, -50.0, 20.0};
    const mechanics::Voigt exact{-30.0, -100.0, -50.0, -20.0};
    for (const int steps : {157, 1571, 15708}) {
        mechanics::Voigt sigma = start;
        for (int k = 0; k < steps; ++k) sigma = turned_voigt(sigma, 0.5 * std::numbers::pi / steps);
        expect_error_within("90 degrees in " + std::to_string(steps) + " steps",
                            (sigma - exact).norm() / start.norm(), 1e-10);
    }
}

TEST(StressRotation, KeepsInvariantsAtAnyAngle) {
    const mechanics::Voigt start{-100.0, -30.0, -50.0, 20.0};
    const mechanics::Voigt end = turned_voigt(start, 0.7);
    const auto s_s = [](const mechanics::Voigt& sigma) {
        const mechanics::Voigt s = mechanics::deviator(sigma);
        return s.head<3>().squaredNorm() + 2.0 * s[3] * s[3];
    };
    expect_error_within("mean stress after 0.7 rad",
                        mechanics::mean_stress(end) / mechanics::mean_stress(start) - 1.0, 1e-14);
    expect_error_within("s:s after 0.7 rad", s_s(end) / s_s(start) - 1.0, 1e-13);
}

TEST(StressRotation, UpdateStressTurnsAStressedPointThatSpins) {
    scene::Scene scene = one_soil(elastic(1e6, 0.3), 1000.0, rectangle(1, 1, 2, 2), 1.0, 4.0, 4.0);
    scene.mpm->anti_locking = scene::AntiLocking::off;
    Body body = filled_body(scene);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.sxx[p] = -100.0, body.points.syy[p] = -30.0;
        body.points.szz[p] = -50.0, body.points.sxy[p] = 20.0;
        body.points.Lxy[p] = -1.0, body.points.Lyx[p] = 1.0;
    }
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) update_stress(body, 0.5 * std::numbers::pi / steps);
    expect_error_within("sigma_xx after 90 degrees", (body.points.sxx[0] + 30.0) / 100.0, 1e-10);
    expect_error_within("sigma_xy after 90 degrees", (body.points.sxy[0] + 20.0) / 100.0, 1e-10);
}

}  // namespace
}  // namespace breach::mpm::test::rotation_test
