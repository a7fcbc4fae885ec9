// The element bench with laws in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "element_bench/programme.hpp"
#include "soils.hpp"

namespace breach::testing::bench_test {
namespace {

using namespace element_bench;
using mechanics::Voigt;

constexpr double E = 20e6, nu = 0.3;

Specimen elastic() {
    return {PlainPoint{materials::LinearElastic{{E, nu}}, {Voigt(-50e3, -100e3, -50e3, 0.0), 0.0}}};
}

Specimen frictional(double c, double phi) {
    const materials::MohrCoulomb law{.elasticity = {E, nu},
                                     .c = c,
                                     .phi = phi,
                                     .psi = 0.0,
                                     .tension_cutoff = 0.0,
                                     .softening = std::nullopt};
    return {PlainPoint{law, {Voigt(-100e3, -100e3, -100e3, 0.0), 0.0}}};
}

void expect_near(const char* what, double computed, double exact, double tolerance) {
    std::printf("%s: computed %.6g exact %.6g relative %.1e (allowed %.0e)\n", what, computed,
                exact, computed / exact - 1.0, tolerance);
    EXPECT_NEAR(computed / exact, 1.0, tolerance);
}

TEST(ElementBench, ElasticShearHasTheShearModulus) {
    const double G = E / (2.0 * (1.0 + nu));
    const Record record =
        monotonic(elastic(), Boundary::undrained_shear, 1e-3, {.step = 1e-4, .every = 1});
    expect_near("tau", record.last.gamma * G, record.readings.back().response, 1e-12);
    const Loop loop = hysteresis(elastic(), Boundary::undrained_shear, 1e-3, 2, 20);
    expect_near("G secant", loop.G_secant.value(), G, 1e-12);
    EXPECT_NEAR(loop.damping.value(), 0.0, 1e-12);
}

TEST(ElementBench, ElasticBiaxialHasThePlaneStrainModulus) {
    // sigma_xx constant, epsilon_zz = 0: d sigma_yy = E / (1 - nu^2) d epsilon_yy, compression
    // positive.
    const Record record =
        monotonic(elastic(), Boundary::drained_biaxial, 1e-3, {.step = 1e-4, .every = 1});
    const double change = record.readings.back().sigma_yy - 100e3;
    expect_near("sigma_yy", change, E / (1.0 - nu * nu) * 1e-3, 1e-9);
    EXPECT_NEAR(record.readings.back().sigma_xx, 50e3, 1e-3);
}

TEST(ElementBench, MohrCoulombBiaxialEndsOnItsLine) {
    const double c = 5e3, phi = 0.5;
    const double K_p = (1.0 + std::sin(phi)) / (1.0 - std::sin(phi));
    const Record record =
        monotonic(frictional(c, phi), Boundary::drained_biaxial, 0.05, {.step = 1e-4, .every = 0});
    const double sigma_1 = 100e3 * K_p + 2.0 * c * std::sqrt(K_p);
    expect_near("sigma_1", record.readings.back().sigma_yy, sigma_1, 1e-6);
}

/// Its cone is fitted to Mohr-Coulomb's strength in plane-strain flow.
TEST(ElementBench, DruckerPragerBiaxialEndsOnMohrCoulombsLine) {
    const double c = 5e3, phi = 0.5;
    const materials::DruckerPrager law{{E, nu}, c, phi, 0.0, 0.0};
    const Specimen specimen{PlainPoint{law, {Voigt(-100e3, -100e3, -100e3, 0.0), 0.0}}};
    const double K_p = (1.0 + std::sin(phi)) / (1.0 - std::sin(phi));
    const Record record =
        monotonic(specimen, Boundary::drained_biaxial, 0.2, {.step = 1e-4, .every = 0});
    const double sigma_1 = 100e3 * K_p + 2.0 * c * std::sqrt(K_p);
    expect_near("sigma_1", record.readings.back().sigma_yy, sigma_1, 1e-6);
}

TEST(ElementBench, PerfectlyPlasticLoopLosesWhatTheRectangleHolds) {
    // tau = tau_y beyond gamma_y: damping = 2 (1 - gamma_y / gamma) / pi (Masing's parallelogram).
    const double c = 10e3, G = E / (2.0 * (1.0 + nu));
    const double gamma_y = c / G, amplitude = 5.0 * gamma_y;
    const Loop loop =
        hysteresis(frictional(c, 1e-9), Boundary::undrained_shear, amplitude, 2, 1000);
    expect_near("damping", loop.damping.value(), 2.0 / M_PI * (1.0 - gamma_y / amplitude), 2e-3);
    expect_near("G secant", loop.G_secant.value(), c / amplitude, 1e-6);
}

/// Loose sand cannot keep sigma_xx at large strain: the loop ends early.
TEST(ElementBench, ALoopThatTheSpecimenDoesNotFinishHasNoNumbers) {
    const pm4sand::Ready law = pm4sand::ready(pm4sand::defaults(0.35, 476.0, 2.70));
    const Specimen sand{SandPoint{law, {}, consolidated(law, 100.0, 0.5)}};
    const auto loop = [&](double amplitude) {
        return hysteresis(sand, Boundary::drained_biaxial, amplitude, 5, 20);
    };
    EXPECT_GT(loop(1e-3).G_secant.value(), 0.0);
    EXPECT_TRUE(loop(1e-3).damping.has_value());
    for (const double amplitude : {0.05, 0.1, 0.2}) {
        const Record record = cyclic_strain(sand, Boundary::drained_biaxial, amplitude, 6,
                                            {.step = amplitude / 20, .every = 1});
        ASSERT_EQ(record.outcome, Ending::failed);
        EXPECT_FALSE(loop(amplitude).G_secant.has_value()) << amplitude;
        EXPECT_FALSE(loop(amplitude).damping.has_value()) << amplitude;
    }
}

/// The peak is within the first call of 1e-2.
TEST(ElementBench, ThePeakIsSoughtBetweenTheCalls) {
    const pm4sand::Ready law = pm4sand::ready(soil("tailings_cal"));
    const Specimen sand{SandPoint{law, {}, consolidated(law, 100.0, 0.5)}};
    const auto shear = [&](double step) {
        return monotonic(sand, Boundary::undrained_shear, 0.1, {.step = step, .every = 0});
    };
    const Record fine = shear(1e-6);
    for (const double step : {1e-4, 1e-3, 1e-2, 0.1}) {
        const Record coarse = shear(step);
        std::printf("    step %g: %.4f kPa at %.3e, %ld calls\n", step, coarse.peak / 1e3,
                    coarse.peak_strain, coarse.calls);
        EXPECT_NEAR(coarse.peak / fine.peak, 1.0, 1e-3) << step;
        EXPECT_NEAR(coarse.peak_strain / fine.peak_strain, 1.0, 0.1) << step;
    }
}

TEST(ElementBench, StressReversalsLieOnTheirTargets) {
    const Specimen specimen = elastic();
    const CyclicResult result =
        cyclic_stress(specimen, Boundary::undrained_shear, {.amplitude = 3e3, .mean = 1e3},
                      {.strain = 1.0, .cycles = 3}, {.step = 7e-5, .every = 1});
    double high = -1e9, low = 1e9;
    for (const Reading& each : result.record.readings) {
        high = std::max(high, each.response);
        low = std::min(low, each.response);
    }
    EXPECT_NEAR(high, 4e3, 1e-5);
    EXPECT_NEAR(low, -2e3, 1e-5);
}

/// Half the stress difference of K0 stays; the cycles go about it.
TEST(ElementBench, CyclesOfABiaxialTestGoAboutTheStressItBeginsWith) {
    for (const Boundary boundary : {Boundary::undrained_biaxial, Boundary::drained_biaxial}) {
        const CyclicResult result = cyclic_stress(elastic(), boundary, {.amplitude = 10e3},
                                                  {.strain = 1.0, .cycles = 2}, {.step = 5e-5});
        const auto& all = result.record.readings;
        EXPECT_EQ(all.front().response, 25e3);
        double high = -1e9, low = 1e9, largest_change = 0.0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            high = std::max(high, all[i].response);
            low = std::min(low, all[i].response);
            if (i == 0) continue;
            largest_change =
                std::max(largest_change, std::abs(all[i].response - all[i - 1].response));
            if (all[i - 1].cycles == 0.0) {
                EXPECT_LT(all[i].cycles, 0.25);
            }
        }
        EXPECT_NEAR(high, 35e3, 1e-4);
        EXPECT_NEAR(low, 15e3, 1e-4);
        EXPECT_LT(largest_change, 2e3);
    }
}

}  // namespace
}  // namespace breach::testing::bench_test
