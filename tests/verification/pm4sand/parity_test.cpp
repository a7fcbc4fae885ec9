// The reference scheme against OpenSees, step by step: replays its strain history and compares the
// stress. The remaining difference comes from drift passes and from the number of parts, which
// round-off decides (docs/reference/methods/pm4sand_integration.md, 13.2, 17).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "soils.hpp"

namespace breach::testing::parity_test {
namespace {

using pm4sand::Options;
using pm4sand::Outcome;
using pm4sand::Ready;
using pm4sand::Scheme;
using pm4sand::State;

constexpr double step = 5e-6;
const Options reference_scheme{.scheme = Scheme::reference};

struct Difference {
    double tau = 0.0;     ///< largest |tau - reference| [kPa]
    double normal = 0.0;  ///< the same of sigma_xx, sigma_yy [kPa]
    double last_tau = 0.0;
    double last_reference = 0.0;
};

/// Shears from row to row in steps of 5e-6 and a remainder.
Difference replay(const std::string& file, const std::string& material, double sigma_v) {
    const Ready law = pm4sand::ready(soil(material));
    State state = consolidated(law, sigma_v, 0.5);
    const auto rows = table(file);
    Difference worst;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        double rest = rows[i][0] - rows[i - 1][0];
        const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(rest) / step - 1e-6)));
        for (int k = 0; k < steps; ++k) {
            const double d = k + 1 < steps ? std::copysign(step, rest) : rest;
            rest -= d;
            const auto update = pm4sand::integrate(law, state, shear(d), reference_scheme);
            EXPECT_EQ(update.outcome, Outcome::done);
            state = update.state;
        }
        const mechanics::Voigt sigma = pm4sand::stress(law, state);
        worst.last_tau = sigma[3] / 1e3;
        worst.last_reference = rows[i][1];
        worst.tau = std::max(worst.tau, std::abs(worst.last_tau - rows[i][1]));
        worst.normal = std::max({worst.normal, std::abs(-sigma[0] / 1e3 - rows[i][2]),
                                 std::abs(-sigma[1] / 1e3 - rows[i][3])});
    }
    std::printf(
        "%-40s tau %.2e kPa (allowed 0.02), normal %.2e kPa (allowed 0.05), last tau "
        "computed %.5f reference %.5f\n",
        file.c_str(), worst.tau, worst.normal, worst.last_tau, worst.last_reference);
    return worst;
}

struct History {
    const char* file;
    const char* material;
    double sigma_v;

    friend std::ostream& operator<<(std::ostream& out, const History& history) {
        return out << history.file;
    }
};

class Parity : public ::testing::TestWithParam<History> {};

TEST_P(Parity, ReferenceSchemeFollowsOpenSeesStepByStep) {
    const Difference worst = replay(GetParam().file, GetParam().material, GetParam().sigma_v);
    EXPECT_LT(worst.tau, 0.02);
    EXPECT_LT(worst.normal, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    OpenSees, Parity,
    ::testing::Values(History{"mono_tailings_cal_sv50.csv", "tailings_cal", 50.0},
                      History{"mono_tailings_cal_sv100.csv", "tailings_cal", 100.0},
                      History{"mono_tailings_def_sv100.csv", "tailings_def", 100.0},
                      History{"cyc_tailings_cal_sv100_csr0.10.csv", "tailings_cal", 100.0},
                      History{"cyc_tailings_def_sv100_csr0.10.csv", "tailings_def", 100.0}));

}  // namespace
}  // namespace breach::testing::parity_test
