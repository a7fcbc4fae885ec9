// Soil whose points are closer than their volumes allow, at rest in a box: stresses and volumes do
// not show it. The correction separates it to the tolerance and reports the energy.
#include "mpm_solver/measure/overlap.hpp"

#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::overlap_test {
namespace {

constexpr double rho = 1500.0;
constexpr double g = 9.81;
constexpr double squeeze = 0.85;  ///< heights of the points over their true heights

scene::Scene squeezed_box(double rate) {
    scene::Scene scene =
        one_soil(sand(2e7, 0.495, 0.0, 0.0), rho, rectangle(0, 0, 4, 8), 1.0, 4.0, 12.0);
    scene.gravity = g;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->right = scene::Wall::roller;
    scene.mpm->fill_points = 3;
    scene.mpm->overlap_correction = {.rate = rate, .tolerance = 0.1};
    return scene;
}

struct Box {
    double overlap_before;
    double overlap;
    double rise;       ///< of the centre of mass, relative to the height that the tolerance leaves
    double lifted;     ///< potential energy gained [J]
    double pushed_in;  ///< energy reported by the correction [J]
};

Box rest(double rate) {
    const scene::Scene scene = squeezed_box(rate);
    Body body = filled_body(scene);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        body.points.y[p] *= squeeze;
        const double weight = -rho / squeeze * g * (8.0 * squeeze - body.points.y[p]);
        body.points.sxx[p] = body.points.syy[p] = body.points.szz[p] = weight;
    }
    OverlapMeter meter(body, scene.thickness);
    const Energy start = energy_of(body);
    Box box{};
    box.overlap_before = meter.measure(body, {1});
    const double y = centre_of_mass(body.points).y();
    int steps = 0;
    advance(body, scene, 3.0, [&](double) {
        if (rate > 0.0 && steps++ % steps_between_marks == 0) meter.mark(body, 0.1);
    });
    box.overlap = meter.measure(body, {1});
    const double allowed = y / squeeze / 1.1 - y;  // fill 1.1 from fill 1 / 0.85
    box.rise = (centre_of_mass(body.points).y() - y) / allowed;
    box.pushed_in = body.tally.pushed_in;
    box.lifted = energy_of(body).gravitational - start.gravitational;
    return box;
}

TEST(Overlap, IsLeftAloneWithoutTheCorrection) {
    const Box box = rest(0.0);
    std::printf("    overlap %.3f, after 3 s %.3f\n", box.overlap_before, box.overlap);
    expect_error_within("change of the overlap", box.overlap - box.overlap_before, 0.05);
    EXPECT_EQ(box.pushed_in, 0.0);
}

// The approach is exponential at 5/s: 3 s leave exp(-15). 15 % of the rise: the soil starts to
// swell at 0.4/s suddenly, and the splash loosens its top cell. The energy put in must exceed the
// lift; splash and rest cost as much again.
TEST(Overlap, IsPushedApartToTheToleranceAndItsEnergyShown) {
    const Box box = rest(5.0);
    std::printf("    overlap %.3f, after 3 s %.3f\n", box.overlap_before, box.overlap);
    EXPECT_LT(box.overlap, 0.1);
    expect_error_within("rise of the centre of mass / closed form - 1", box.rise - 1.0, 0.15);
    std::printf("    put in %.0f J, lifted %.0f J\n", box.pushed_in, box.lifted);
    EXPECT_GT(box.pushed_in, box.lifted);
    EXPECT_LT(box.pushed_in, 3.0 * box.lifted);
}

}  // namespace
}  // namespace breach::mpm::test::overlap_test
