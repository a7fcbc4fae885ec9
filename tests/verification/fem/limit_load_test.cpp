// Plastic limit load of a strip footing on clay: Prandtl's (2 + pi) c.
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem {
namespace {

using bench::expect_error;

/// Largest uniform pressure over c that weightless clay carries on 0 <= x <= 1 m (half the
/// footing), found by halving the load step until it is 0.2 % of the load.
double limit_pressure(int per_metre) {
    constexpr double c = 100e3;
    bench::Block block{
        .width = 5.0, .height = 3.0, .columns = 5 * per_metre, .rows = 3 * per_metre};
    block.law = {{"type", "mohr_coulomb"}, {"E_MPa", 50},  {"nu", 0.45},
                 {"c_kPa", 100},           {"phi_deg", 0}, {"tension_cutoff_kPa", 1e6}};
    block.gravity = 0.0;
    Model model = bench::model_of(bench::parse(bench::scene_of(block)));
    const double h = 1.0 / per_metre;
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const Vec2 x = model.mesh.nodes[i];
        if (x.y() < 3.0 - 1e-9 || x.x() > 1.0 + 1e-9) continue;
        const bool end = x.x() < 1e-9 || x.x() > 1.0 - 1e-9;
        model.external_force[static_cast<Eigen::Index>(2 * i + 1)] = -c * h * (end ? 0.5 : 1.0);
    }
    Seconds seconds;
    Newton newton(model, Solved::displacement, {1e-5, 40}, Symmetry::general, seconds);
    const auto laws = laws_for(model, scene::StageLaws::scene);
    Motion motion = at_rest(model), trial = motion;
    Prediction prediction = prediction_for(model);
    const Eigen::VectorXd no_force = Eigen::VectorXd::Zero(model.dofs());
    double q = 0.0, step = 1.0;
    while (step > 0.002 * 5.0) {
        const auto outcome =
            static_step(newton, model, laws, q + step, no_force, motion, prediction, trial);
        if (outcome.end == NewtonOutcome::End::converged) {
            std::swap(motion, trial);
            q += step;
        } else {
            step *= 0.5;
        }
    }
    std::printf("    h = 1/%d: q / c = %.3f, %lld iterations, %.2f s\n", per_metre, q,
                static_cast<long long>(newton.counts().iterations),
                seconds.solve + seconds.law + seconds.assembly);
    return q;
}

TEST(StripFooting, CarriesPrandtlsLoad) {
    const double exact = 2.0 + std::numbers::pi;
    const double coarse = limit_pressure(4), fine = limit_pressure(8);
    // Displacement elements approach from above, with an error that halves with the element size.
    EXPECT_GT(coarse, fine);
    expect_error("Prandtl: q / ((2 + pi) c) - 1, 8 elements under half the footing",
                 std::abs(fine / exact - 1.0), 0.03);
}

}  // namespace
}  // namespace breach::fem
