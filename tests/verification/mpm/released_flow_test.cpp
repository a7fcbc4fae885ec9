// Released water and aluminium bars: Ritter's dam break, and the experiment of Bui et al. (2008).
#include "mpm_solver/measure/flow.hpp"
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::released_flow_test {
namespace {

constexpr double g = 9.81;

/// Ritter (1892): depth at x from the gate.
double ritter(double h_0, double x, double t) {
    const double c = std::sqrt(g * h_0);
    if (x <= -c * t) return h_0;
    if (x >= 2.0 * c * t) return 0.0;
    const double u = 2.0 * c - x / t;
    return u * u / (9.0 * g);
}

// Ritter's equations are for long waves: near the gate the water also falls, so the limits are 5 %
// there and 10 % for the profile.
TEST(DamBreak, DepthsAreRitters) {
    const double h_0 = 4.0;
    const double gate = 20.0;
    const double t = 2.2;
    scene::Scene scene =
        one_soil(sand(1e6, 0.495, 0.0, 0.0), 1000.0, rectangle(0, 0, gate, h_0), 0.5, 60.0, 6.0);
    scene.gravity = g;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->fill_stress = scene::FillStress::overburden;
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    advance(body, scene, t);
    const FlowView view = flow_view(scene, body.grid);
    expect_error_within("depth at the gate / (4/9 h_0)",
                        flow_at(body.points, view, gate).depth / (4.0 / 9.0 * h_0) - 1.0, 0.05);
    const std::vector<Flow> profile = flow_profile(body.points, view);
    const std::vector<double> places = profile_places(view);
    double off = 0.0;
    double all = 0.0;
    const double c = std::sqrt(g * h_0);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double x = places[k] - gate;
        if (x < -c * t || x > 2.0 * c * t) continue;
        off += std::abs(profile[k].depth - ritter(h_0, x, t));
        all += ritter(h_0, x, t);
    }
    expect_error_within("profile between the waves, L1", off / all, 0.10);
    const Energy end = energy_of(body);
    std::printf("    numerical share of the released energy %.3f\n", numerical_share(start, end));
}

struct Surface {
    double x;
    double y;
};

// Bui, Fukagawa, Sako & Ohno (2008), 0.2 x 0.1 m of aluminium bars; final surface as digitised by
// open MPM and SPH codes. phi = 19.8 degrees, no cohesion, rough base. Tolerance: a
// bar's diameter is 1.5-3 mm, and one repetition differs from the next by as much.
constexpr Surface measured[] = {{0.0, .0992},  {.040, .0959}, {.080, .0844}, {.120, .0722},
                                {.160, .0616}, {.200, .0474}, {.241, .0348}, {.282, .0265},
                                {.322, .0189}, {.362, .0109}, {.402, .0037}, {.442, .0015}};

TEST(AluminiumBars, SurfaceIsTheMeasuredOne) {
    scene::Scene scene =
        one_soil(sand(0.84e6, 0.3, 0.0, 19.8), 2650.0, rectangle(0, 0, 0.2, 0.1), 0.01, 0.6, 0.14);
    scene.gravity = g;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {};
    scene.mpm->fill_points = 3;
    Body body = filled_body(scene);
    advance(body, scene, 1.0);
    const FlowView view = flow_view(scene, body.grid);
    double off = 0.0;
    for (const Surface& at : measured) {
        const double y = flow_at(body.points, view, at.x).depth;
        std::printf("    x = %.3f m: %.4f m, measured %.4f m\n", at.x, y, at.y);
        off += std::abs(y - at.y) / std::size(measured);
    }
    expect_error_within("mean distance from the measured surface / height", off / 0.1, 0.06);
}

}  // namespace
}  // namespace breach::mpm::test::released_flow_test
