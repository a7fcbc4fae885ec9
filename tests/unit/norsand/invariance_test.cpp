// NorSand is isotropic and dissipative: rotated axes give the rotated result, out-of-plane
// deformation the same stress, and the plastic work is p M_i d epsilon_q.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/materials/rotated_stress.hpp"
#include "tests/verification/norsand/soils.hpp"

namespace breach::testing {
namespace {

using namespace norsand;
using mechanics::Voigt;

const Options tight{.tolerance = 1e-7, .most_evaluations = 10000};

/// Strain rotated as a tensor; engineering shear.
Voigt turned_strain(const Voigt& strain, double angle) {
    Voigt tensor = strain;
    tensor[3] *= 0.5;
    tensor = rotated_stress(tensor, angle);
    tensor[3] *= 2.0;
    return tensor;
}

/// A path with changing directions and unloading.
Voigt strain_of(int step) {
    const double t = 0.07 * step;
    const double way = step % 60 < 50 ? 1e-4 : -1e-4;
    return way * Voigt(0.4 * std::sin(t), -1.0 + 0.5 * std::cos(2.0 * t), 0.3 * std::sin(3.0 * t),
                       2.0 * std::cos(1.3 * t));
}

State begun(const Ready& law, const Voigt& sigma) {
    return initialise(law, sigma, 0.03 + critical_void_ratio(law, 90e3)).state;
}

TEST(NorSandInvariance, TurnedAxesGiveTheTurnedAnswer) {
    // `normal` has a vertex in triaxial compression, to which this path returns.
    for (const FlowRule rule : {FlowRule::js, FlowRule::radial}) {
        Parameters parameters = soil("CJ2");
        parameters.flow = rule;
        parameters.S = 1.0;
        const Ready law = ready(parameters);
        const Voigt sigma(-80e3, -120e3, -70e3, 5e3);
        for (const double angle : {0.3, 1.2, -2.0}) {
            State straight = begun(law, sigma);
            State turned = begun(law, rotated_stress(sigma, angle));
            int plastic = 0;
            for (int i = 0; i < 300; ++i) {
                const Update a = integrate(law, straight, strain_of(i), tight);
                const Update b = integrate(law, turned, turned_strain(strain_of(i), angle), tight);
                ASSERT_EQ(a.outcome, Outcome::done);
                ASSERT_EQ(b.outcome, Outcome::done);
                straight = a.state;
                turned = b.state;
                plastic += a.counts.sub_steps > 0;
            }
            EXPECT_GT(plastic, 100);
            EXPECT_LT(plastic, 300);
            const Voigt back = rotated_stress(stress(straight), angle);
            EXPECT_LT((stress(turned) - back).norm() / back.norm(), 1e-6);
            EXPECT_NEAR(turned.p_i / straight.p_i, 1.0, 1e-6);
            EXPECT_NEAR(turned.epsilon_q, straight.epsilon_q, 1e-7);
        }
    }
}

TEST(NorSandInvariance, TheAxesAreWorthTheSame) {
    // A shear-free path with all permutations of its axes.
    const Ready law = ready(soil("CJ1"));
    const int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}};
    const double sigma[3] = {-80e3, -120e3, -70e3};
    const double strain[3] = {0.7e-4, -1e-4, 0.1e-4};
    std::vector<double> first;
    for (const auto& order : orders) {
        const Voigt start(sigma[order[0]], sigma[order[1]], sigma[order[2]], 0.0);
        const Voigt d(strain[order[0]], strain[order[1]], strain[order[2]], 0.0);
        State state = begun(law, start);
        for (int i = 0; i < 200; ++i) state = integrate(law, state, d, tight).state;
        const Voigt end = stress(state);
        std::vector<double> sorted(3);
        for (int k = 0; k < 3; ++k) sorted[order[k]] = end[k];
        if (first.empty()) first = sorted;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(sorted[k] / first[k], 1.0, 1e-7);
    }
}

TEST(NorSandInvariance, SemiLogLineAndLinearModuliScaleWithPressure) {
    // m = 1 and constant psi: curves at different pressures coincide.
    Parameters parameters = soil("CJ1");
    parameters.S = 1.0;
    std::vector<double> ratios;
    for (const double sigma_v : {50e3, 800e3}) {
        const auto record = element_bench::monotonic(specimen(parameters, sigma_v, 0.7, 0.05),
                                                     element_bench::Boundary::undrained_shear, 0.05,
                                                     {.step = 1e-4, .every = 0});
        ratios.push_back(record.readings.back().response / sigma_v);
    }
    EXPECT_NEAR(ratios[0] / ratios[1], 1.0, 1e-6);
}

TEST(NorSandDissipation, PlasticWorkIsThatOfTheSurfaceAndNeverNegative) {
    for (const FlowRule rule : {FlowRule::js, FlowRule::radial}) {
        Parameters parameters = soil("CJ1");
        parameters.flow = rule;
        parameters.S = 1.0;
        const Ready law = ready(parameters);
        for (const double psi : {-0.08, 0.05}) {
            State state = initialise(law, Voigt(-80e3, -120e3, -70e3, 5e3),
                                     psi + critical_void_ratio(law, 90e3))
                              .state;
            int plastic = 0;
            for (int i = 0; i < 400; ++i) {
                const Voigt d = 0.02 * strain_of(i);
                const Reading before = read(law, state);
                const Update update = integrate(law, state, d, tight);
                const Voigt middle = 0.5 * (stress(state) + stress(update.state));
                // Elastic strain of the increment by the mean modulus.
                const double G = 0.5 * (before.G + read(law, update.state).G);
                const mechanics::Elasticity elasticity{2.0 * (1.0 + 0.15) * G, 0.15};
                const Voigt elastic =
                    mechanics::elastic_strain(elasticity, stress(update.state) - stress(state));
                const double work = middle.dot(d - elastic);
                const double d_epsilon_q = update.state.epsilon_q - state.epsilon_q;
                EXPECT_GE(d_epsilon_q, 0.0);
                const Reading after = read(law, update.state);
                const double expected =
                    0.5 * (before.p * before.M_i + after.p * after.M_i) * d_epsilon_q;
                // Only while the whole increment is plastic are its ends on the surface.
                if (before.F > -1e-6 * before.p && after.F > -1e-6 * after.p) {
                    EXPECT_NEAR(work, expected, 0.02 * expected + 1e-4);
                }
                plastic += d_epsilon_q > 0.0;
                state = update.state;
            }
            EXPECT_GT(plastic, 200);
        }
    }
}

}  // namespace
}  // namespace breach::testing
