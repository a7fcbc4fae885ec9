// With Courant numbers from 0.1 to 0.7 no point is lost, in the shipped column, the shipped slope
// and a coarse Mochikoshi-like runout.
#include "mpm_solver/measure/guard.hpp"
#include "mpm_solver/measure/runout.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::courant_range_test {
namespace {

void expect_whole(const std::string& name, const std::vector<std::string>& overrides, double end) {
    scene::Scene scene =
        scene::read_scene(BREACH_ROOT "/workflows/scenes/" + name + ".json", overrides);
    for (const double cfl : {0.1, 0.2, 0.4, 0.7}) {
        scene.mpm->cfl = cfl;
        Body body = filled_body(scene);
        const Energy start = energy_of(body);
        const Limits limits = limits_of(body, *scene.mpm, start);
        const std::vector<std::uint8_t> mobile = mobile_regions(scene);
        const double volume = volume_of(body.points, mobile);
        advance(body, scene, end, [&](double) {
            if (const auto complaint = step_complaint(body, limits)) {
                throw std::runtime_error(*complaint);
            }
        });
        const Energy now = energy_of(body);
        const double ratio = volume_of(body.points, mobile) / volume;
        const auto complaint = budget_complaint(limits, start, now, ratio);
        EXPECT_FALSE(complaint) << *complaint;
        std::printf("    %s, CFL %.1f: R %.2f m, numerical share %.3f, volume ratio %.3f\n",
                    name.c_str(), cfl,
                    runout_of(body.points, mobile, scene.mpm->runout.toe.x()).all,
                    numerical_share(start, now), ratio);
        EXPECT_NEAR(ratio, 1.0, 0.1) << name << " at CFL " << cfl;
    }
}

TEST(CourantRange, ColumnStaysWhole) { expect_whole("column", {}, 4.0); }

TEST(CourantRange, SlopeStaysWhole) { expect_whole("slope", {}, 3.0); }

TEST(CourantRange, MochikoshiStaysWhole) {
    expect_whole("mochikoshi_runout",
                 {"/mpm/cell_size=5", "/mpm/allow_coarse_cells=true", "/mpm/fill_points=2",
                  "/mpm/stiffness_scale=0.03"},
                 20.0);
}

}  // namespace
}  // namespace breach::mpm::test::courant_range_test
