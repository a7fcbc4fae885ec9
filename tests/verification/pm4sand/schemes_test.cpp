// Differences of the two schemes: the corrected one against the reference, which is biased in flow
// (docs/reference/methods/pm4sand_integration.md, 17) and moves alpha along b where it drifts
// (docs/reference/methods/pm4sand.md, section 8).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "element_bench/programme.hpp"
#include "soils.hpp"

namespace breach::testing::schemes_test {
namespace {

using namespace element_bench;
using pm4sand::Options;
using pm4sand::Scheme;

Specimen specimen(const char* name, double sigma_v, const Options& options, double K0 = 0.5) {
    const pm4sand::Ready law = pm4sand::ready(soil(name));
    return {SandPoint{law, options, consolidated(law, sigma_v, K0)}};
}

TEST(Schemes, UndrainedStrengthOfTheDefaultSchemeDoesNotDependOnTheStep) {
    // Limit of vanishing steps at 100 kPa: 5.827 kPa
    // (docs/reference/methods/pm4sand_integration.md, 17); allowed 0.1 %.
    for (const double sigma_v : {50.0, 100.0, 250.0}) {
        const auto strength = [&](double step, const Options& options) {
            return monotonic(specimen("tailings_cal", sigma_v, options), Boundary::undrained_shear,
                             0.1, {.step = step, .every = 0})
                       .readings.back()
                       .response /
                   1e3;
        };
        const double limit = strength(1e-6, {.tolerance = 1e-6});
        const double biased = strength(5e-6, {.scheme = Scheme::reference});
        std::printf("%3.0f kPa: limit %.4f, reference scheme %.4f (%+.2f %%);", sigma_v, limit,
                    biased, 100.0 * (biased / limit - 1.0));
        for (const double step : {1e-6, 1e-5, 1e-4, 1e-3}) {
            const double s_u = strength(step, {});
            std::printf(" step %.0e %.4f (%+.3f %%)", step, s_u, 100.0 * (s_u / limit - 1.0));
            EXPECT_NEAR(s_u / limit, 1.0, 1e-3);
        }
        std::printf("\n");
        if (sigma_v == 100.0) {
            EXPECT_NEAR(limit / 5.827, 1.0, 1e-3);
        }
    }
}

Specimen sheared(const pm4sand::Parameters& soil, double K0, double static_shear) {
    const pm4sand::Ready law = pm4sand::ready(soil);
    const mechanics::Voigt sigma(-100e3 * K0, -100e3, -50e3 * K0, 100e3 * static_shear);
    return {SandPoint{law, {}, pm4sand::initialise(law, sigma)}};
}

pm4sand::Parameters very_loose() {
    pm4sand::Parameters law = pm4sand::defaults(0.2, 476.0, 1.0);
    law.R = 3.0;
    return law;
}

/// Looser than critical, a stress may start between the bound and M_d. Further loading is no
/// reversal: the strength equals that of a start just inside. As a reversal it would be seven times
/// higher at 10 %.
TEST(Schemes, UndrainedShearFromOutsideTheBoundIsNoReversal) {
    const struct {
        pm4sand::Parameters soil;
        double K0, inside, outside, strain;
    } rows[]{{soil("tailings_cal"), 1.0, 0.525, 0.53, 0.1},
             {soil("tailings_cal"), 0.5, 0.31, 0.312, 0.1},
             {very_loose(), 1.0, 0.51, 0.52, 0.004}};
    for (const auto& row : rows) {
        const auto tau = [&](double static_shear, double step) {
            return monotonic(sheared(row.soil, row.K0, static_shear), Boundary::undrained_shear,
                             row.strain, {.step = step, .every = 0})
                       .readings.back()
                       .response /
                   1e3;
        };
        const double inside = tau(row.inside, 1e-4);
        for (const double step : {1e-4, 1e-5}) {
            const double outside = tau(row.outside, step);
            std::printf("K0 %.1f: static shear %.3f tau %.3f kPa, %.3f tau %.3f kPa\n", row.K0,
                        row.inside, inside, row.outside, outside);
            EXPECT_NEAR(outside / inside, 1.0, 0.02);
        }
    }
}

/// The tailings' bound is at K0 = 0.303. A point that starts on it, or slightly outside, behaves
/// like its neighbours.
TEST(Schemes, UndrainedShearDoesNotDependOnTheSideOfTheBoundWhereItBegins) {
    const auto tau = [](double K0, double strain, double step) {
        return monotonic(specimen("tailings_cal", 100.0, {}, K0), Boundary::undrained_shear, strain,
                         {.step = step, .every = 0})
                   .readings.back()
                   .response /
               1e3;
    };
    for (const double strain : {0.004, 0.1}) {
        double before = tau(0.315, strain, 1e-4);
        for (const double K0 : {0.31, 0.305, 0.303, 0.30, 0.29, 0.28, 0.27, 0.26, 0.25}) {
            const double here = tau(K0, strain, 1e-4);
            std::printf("K0 %.3f strain %.3f: tau %.3f kPa\n", K0, strain, here);
            EXPECT_NEAR(here / before, 1.0, 0.03) << K0;
            EXPECT_NEAR(here / tau(K0, strain, 1e-5), 1.0, 2e-3) << K0;
            before = here;
        }
    }
}

struct Drained {
    const char* soil;
    double allowed;  ///< kPa: what docs/reference/methods/pm4sand.md, section 8, says, with room
};

/// Volumetric dilation after the largest contraction.
double dilation_of(const Record& record) {
    double most = -1.0;
    for (const Reading& each : record.readings) most = std::max(most, each.epsilon_v);
    return most - record.readings.back().epsilon_v;
}

TEST(Schemes, DrainedShearDiffersAsTheDocumentSays) {
    for (const Drained& row : {Drained{"tailings_cal", 0.04}, Drained{"tailings_def", 0.12},
                               Drained{"embankment", 0.8}, Drained{"foundation", 1.6}}) {
        const Pace pace{.step = 5e-6, .every = 200};
        const Record reference = monotonic(specimen(row.soil, 100.0, {.scheme = Scheme::reference}),
                                           Boundary::drained_shear, 0.05, pace);
        const Record usual =
            monotonic(specimen(row.soil, 100.0, {}), Boundary::drained_shear, 0.05, pace);
        double tau = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < reference.readings.size(); ++i) {
            const Reading &a = reference.readings[i], &b = usual.readings[i];
            tau = std::max(tau, std::abs(a.response - b.response) / 1e3);
            largest = std::max(largest, a.response / 1e3);
        }
        std::printf(
            "%-13s drained: largest tau %.2f kPa, schemes differ by %.3f kPa (allowed "
            "%.2f), dilation %.4e and %.4e\n",
            row.soil, largest, tau, row.allowed, dilation_of(reference), dilation_of(usual));
        EXPECT_EQ(reference.outcome, Ending::done);
        EXPECT_EQ(usual.outcome, Ending::done);
        EXPECT_LT(tau, row.allowed);
        EXPECT_LE(dilation_of(usual), dilation_of(reference));
        EXPECT_GE(dilation_of(usual), 0.945 * dilation_of(reference));
    }
}

}  // namespace
}  // namespace breach::testing::schemes_test
