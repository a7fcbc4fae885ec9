// A soil layer under its own weight between smooth walls: stress, K0 and settlement in closed form.
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::gravity_test {
namespace {

using bench::expect_error;

TEST(GravityColumn, HasExactStressAndSettlement) {
    const double H = 20.0, E = 20e6, nu = 0.3, rho = 2000.0, g = 9.81;
    bench::Run run(bench::scene_of({.width = 4.0, .height = H, .columns = 3, .rows = 10}));
    const Course& a = run.go();
    const double M = mechanics::Elasticity{E, nu}.constrained_modulus();
    double stress_error = 0.0, ratio_error = 0.0, settlement_error = 0.0;
    for (std::size_t e = 0; e < a.model.mesh.quads.size(); ++e) {
        const double y = corners_of(a.model.mesh, e).row(1).mean();
        const double exact = -rho * g * (H - y);  // linear: the element has its value at the middle
        for (std::size_t k = 0; k < gauss_points; ++k) {
            const Voigt& s = a.motion.points[e * gauss_points + k].sigma;
            stress_error = std::max(stress_error, std::abs(s[1] - exact) / (rho * g * H));
            ratio_error = std::max(ratio_error, std::abs(s[0] / s[1] - nu / (1.0 - nu)));
        }
    }
    const double largest = rho * g * H * H / (2.0 * M);
    for (std::size_t i = 0; i < a.model.mesh.nodes.size(); ++i) {
        const double y = a.model.mesh.nodes[i].y();
        const double exact = -rho * g / M * (H * y - 0.5 * y * y);
        const double u_y = a.motion.u[static_cast<Eigen::Index>(2 * i + 1)];
        settlement_error = std::max(settlement_error, std::abs(u_y - exact) / largest);
    }
    // Linear quads have the exact nodal values of this one-dimensional problem: only round-off
    // remains.
    expect_error("vertical stress", stress_error, 1e-12);
    expect_error("K0 = nu / (1 - nu)", ratio_error, 1e-12);
    expect_error("settlement", settlement_error, 1e-12);
}

TEST(GravityColumn, WeighsWhatItsMassSays) {
    bench::Run run(bench::scene_of({.width = 3.0, .height = 5.0, .columns = 4, .rows = 6}));
    double mass = 0.0;
    for (const double m : run.course().model.nodal_mass) mass += m;
    expect_error("total mass", std::abs(mass / (2000.0 * 15.0) - 1.0), 1e-14);
}

TEST(GravityColumn, StaysInEquilibriumWhenTheSceneLawCanCarryIt) {
    // phi 35: K0 = 0.43 is inside the yield surface; a dynamic stage must not move.
    bench::Block block{.width = 4.0, .height = 10.0, .columns = 4, .rows = 10};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 5}, {"phi_deg", 35}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "wait"}, {"duration", 1.0}, {"time_step", 0.01}});
    bench::Run run(bench::scene_of(block));
    const Course& a = run.go();
    expect_error("displacement of soil in equilibrium [m]", a.motion.u.lpNorm<Eigen::Infinity>(),
                 1e-10);
}

}  // namespace
}  // namespace breach::fem::gravity_test
