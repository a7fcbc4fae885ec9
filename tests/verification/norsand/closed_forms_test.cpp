// NorSand against known results: the critical state line, the peaks of the open table, and the
// published runs of Cheng & Jefferies (2020, Geo-Congress GSP 318) and of the authors' workbook
// (docs/verification/static_liquefaction.md).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/norsand/soils.hpp"

namespace breach::testing::closed_forms_test {
namespace {

using element_bench::Boundary;
using element_bench::Ending;
using element_bench::Record;

/// Shears to `strain`; with steps of 2e-5 the peak is accurate to 1e-5.
Record sheared(const element_bench::Specimen& start, Boundary boundary, double strain,
               double step = 1e-4) {
    Record record = element_bench::monotonic(start, boundary, strain, {.step = step, .every = 1});
    EXPECT_EQ(record.outcome, Ending::done);
    return record;
}

norsand::Parameters with(const char* name, double S,
                         norsand::FlowRule flow = norsand::FlowRule::js) {
    norsand::Parameters parameters = soil(name);
    parameters.S = S;
    parameters.flow = flow;
    return parameters;
}

TEST(NorSandClosedForms, UndrainedTestsWithSofteningEndOnTheCriticalStateLine) {
    for (const char* name : {"CJ1", "CJ2", "NK", "NKu", "TC"}) {
        const norsand::Parameters parameters = with(name, 1.0);
        const norsand::Ready law = norsand::ready(parameters);
        const double psi = name == std::string("TC") ? 0.03 : 0.04;
        const auto start = specimen(parameters, 200e3, 1.0, psi);
        const double p_c = norsand::critical_pressure(law, state_of(start).e);
        for (const Boundary boundary :
             {Boundary::undrained_compression, Boundary::undrained_extension}) {
            const auto last = reading(sheared(start, boundary, 0.6, 2e-4).last);
            const double M =
                boundary == Boundary::undrained_compression ? parameters.M_tc : law.M_te;
            EXPECT_NEAR(last.p / p_c, 1.0, 0.02) << name;
            EXPECT_NEAR(last.q / last.p / M, 1.0, 2e-3) << name;
        }
    }
}

TEST(NorSandClosedForms, PlaneStrainEndsAtTheCriticalAngleOfItsFlowRule) {
    for (const auto flow :
         {norsand::FlowRule::js, norsand::FlowRule::radial, norsand::FlowRule::normal}) {
        const norsand::Parameters parameters = with("CJ1", 1.0, flow);
        const norsand::Ready law = norsand::ready(parameters);
        const double theta = norsand::plane_critical_angle(law);
        const double M = norsand::critical_ratio(law, theta);
        const auto start = specimen(parameters, 100e3, 0.7, 0.05);
        const auto record = sheared(start, Boundary::undrained_shear, 0.8, 4e-4);
        const auto last = reading(record.last);
        EXPECT_NEAR(last.theta, theta, 2e-3);
        const double tau = element_bench::response(record.last, Boundary::undrained_shear);
        EXPECT_NEAR(tau / last.p / (M * std::cos(theta) / std::sqrt(3.0)), 1.0, 5e-3);
        const double sigma_v = -element_bench::stress(record.last)[1];
        const double ratio =
            M / std::sqrt(3.0) * std::cos(theta) / (1.0 + M / 3.0 * std::sin(theta));
        EXPECT_NEAR(tau / sigma_v / ratio, 1.0, 5e-3);
    }
}

TEST(NorSandClosedForms, DrainedTestsEndOnTheLineAtTheCriticalRatio) {
    for (const double psi : {-0.03, 0.0, 0.05}) {
        const norsand::Parameters parameters = with("CJ1", 0.0);
        const norsand::Ready law = norsand::ready(parameters);
        const auto record = sheared(specimen(parameters, 100e3, 1.0, psi),
                                    Boundary::drained_compression, 0.8, 4e-4);
        const auto last = reading(record.last);
        EXPECT_NEAR(last.p / (3.0 * 100e3 / (3.0 - last.q / last.p)), 1.0, 1e-6);
        EXPECT_NEAR(last.q / last.p, 1.2, 0.01) << psi;
        EXPECT_NEAR(last.psi, 0.0, 0.005) << psi;
        EXPECT_NEAR(last.psi, state_of(record.last).e - norsand::critical_void_ratio(law, last.p),
                    1e-12);
    }
}

TEST(NorSandClosedForms, DilatancyOfDenseSoilIsThatOfItsStateParameter) {
    const norsand::Parameters parameters = with("CJ1", 0.0);
    const norsand::Ready law = norsand::ready(parameters);
    const auto record =
        sheared(specimen(parameters, 100e3, 1.0, -0.1), Boundary::drained_compression, 0.1);
    double least = 0.0, wanted = 0.0, peak = 0.0;
    for (const auto& each : record.readings) {
        const norsand::Reading seen = norsand::read(law, *each.norsand);
        peak = std::max(peak, seen.q / seen.p);
        if (seen.D >= least) continue;
        least = seen.D;
        wanted = each.norsand->chi_i * seen.psi_i;
    }
    // Not exact, for H is finite; the peak ratio is M_i - D there.
    EXPECT_NEAR(least / wanted, 1.0, 0.005);
    EXPECT_NEAR(least, -0.29170, 1e-4);
    EXPECT_NEAR(peak, 1.404552, 2e-4 * 1.4);
}

TEST(NorSandClosedForms, ElasticSoilKeepsItsPressureUndrained) {
    norsand::Parameters parameters = with("CJ1", 0.0);
    const auto start = specimen(parameters, 100e3, 1.0, -0.2, {.tolerance = 1e-6}, 3.0);
    const auto record = sheared(start, Boundary::undrained_compression, 4e-4, 1e-5);
    EXPECT_EQ(record.counts.norsand.sub_steps, 0);
    EXPECT_NEAR(reading(record.last).p / 100e3, 1.0, 1e-12);
    EXPECT_NEAR(reading(record.last).q / (3.0 * 30e6 * 4e-4), 1.0, 1e-9);
}

}  // namespace
}  // namespace breach::testing::closed_forms_test
