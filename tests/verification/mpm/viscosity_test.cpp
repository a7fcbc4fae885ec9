// Soil flows down between two rough walls under its own weight. In steady flow the shear stress is
// rho g x: a Newtonian fluid has Poiseuille's parabola, a Bingham fluid (yield strength c) a plug
// of half width c / (rho g), and only viscosity and plastic work dissipate energy.
#include "tests/unit/mpm/bodies.hpp"
#include "tests/verification/mpm/report.hpp"

namespace breach::mpm::test::viscosity_test {
namespace {

constexpr double rho = 1000.0;
constexpr double g = 1.0;
constexpr double eta = 2000.0;
constexpr double half_width = 1.0;
constexpr double height = 5.0;

scene::Scene channel(double c) {
    const double h = 0.2;
    const materials::MohrCoulomb fluid{.elasticity = {.E = 2e5, .nu = 0.3},
                                       .c = c,
                                       .phi = 0.0,
                                       .psi = 0.0,
                                       .tension_cutoff = 1e9,  // the ends must not open
                                       .softening = {}};
    scene::Scene scene =
        one_soil(fluid, rho, rectangle(0, 1, 2.0 * half_width, 1.0 + height), h, 2.0, 7.0);
    scene.gravity = g;
    scene.mpm->left = scene::Wall::fixed;
    scene.mpm->right = scene::Wall::fixed;
    scene.materials[0].viscosity = eta;
    return scene;
}

/// Downward velocity of the steady flow at a distance x from the middle; Newtonian for c = 0.
double steady(double x, double c) {
    const double plug = c / (rho * g);
    const double sheared = std::max(std::abs(x), plug);
    return rho * g / (2.0 * eta) * (half_width * half_width - sheared * sheared) -
           c / eta * (half_width - sheared);
}

struct Flow {
    double profile_error;  ///< L2 over the middle third of the height, relative to the fastest
    double numerical_share;
    double viscous_share;  ///< of viscous and plastic dissipation
};

/// Five relaxation times of the slowest mode, (2 a / pi)^2 rho / eta = 0.2 s.
Flow fall(const scene::Scene& scene, double c) {
    Body body = filled_body(scene);
    const Energy start = energy_of(body);
    const double y_0 = centre_of_mass(body.points).y();
    advance(body, scene, 1.0);
    const double y_1 = centre_of_mass(body.points).y();
    EXPECT_LT(y_1, y_0);
    double squares = 0.0;
    int count = 0;
    const Points& points = body.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (std::abs(points.y[p] - y_1) > height / 6.0) continue;
        const double off = -points.vy[p] - steady(points.x[p] - half_width, c);
        squares += off * off;
        ++count;
    }
    const Energy now = energy_of(body);
    return {std::sqrt(squares / count) / steady(0.0, c), numerical_share(start, now),
            now.viscous / (now.viscous + now.plastic)};
}

// 2 %: exp(-5) of the slowest mode is 0.7 %, the rest is due to ten cells over the width.
TEST(Viscosity, NewtonianSoilFallsAsPoiseuilleSays) {
    const Flow flow = fall(channel(0.0), 0.0);
    expect_error_within("parabola, L2 / fastest", flow.profile_error, 0.02);
    expect_error_within("energy unaccounted for / released", flow.numerical_share, 0.02);
    expect_error_within("plastic share of a soil without strength", 1.0 - flow.viscous_share, 1e-9);
}

// In the sheared soil, tau = c + eta d gamma / dt at every x: the powers follow from the profile.
TEST(Viscosity, SoilOfYieldStrengthFallsAsBinghamSays) {
    const double c = 300.0;
    const Flow flow = fall(channel(c), c);
    expect_error_within("plug and parabolas, L2 / fastest", flow.profile_error, 0.03);
    expect_error_within("energy unaccounted for / released", flow.numerical_share, 0.03);
}

TEST(Viscosity, TheStepFollowsAViscosityThatRulesIt) {
    // eta / (rho h) is 50 times the wave speed: unstable with the wave's time step.
    scene::Scene scene = channel(0.0);
    scene.materials[0].viscosity = 1e5;
    Body body = filled_body(scene);
    scene.mpm->cfl = 0.8;
    advance(body, scene, 0.05);
    const double bound = rho * g / (2.0 * 1e5) * half_width * half_width;
    expect_error_within("eta 1e5 Pa s, CFL 0.8: fastest / steady flow", body.tally.fastest / bound,
                        1.5);
}

}  // namespace
}  // namespace breach::mpm::test::viscosity_test
