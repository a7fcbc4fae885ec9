// Parameters, initial states and state functions against the numbers of
// docs/reference/methods/pm4sand.md in an independent implementation, kPa.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/materials/pm4sand/functions.hpp"
#include "tests/verification/pm4sand/soils.hpp"

namespace breach::testing {
namespace {

using namespace pm4sand;

TEST(Pm4SandParameters, SecondaryDefaultsAreThoseOfTheTable) {
    const double rows[][6] = {{.35, 0.300, 0.5, 5, 5.16038, 0.0745297},
                              {.55, 0.400, 0.5, 10, 10.3656, 0.125361},
                              {.75, 0.500, 0.2, 10, 30.8828, 0.210861}};
    for (const auto& row : rows) {
        const Parameters law = defaults(row[0], 476.0, 0.5);
        EXPECT_NEAR(law.h_0, row[1], 1e-12);
        EXPECT_NEAR(law.c_epsilon, row[2], 1e-12);
        EXPECT_NEAR(law.C_DR, row[3], 1e-12);
        EXPECT_NEAR(law.C_Kaf / row[4], 1.0, 3e-6);
        EXPECT_NEAR(law.F_sed_min / row[5], 1.0, 3e-6);
    }
    EXPECT_NEAR(ready(defaults(.35, 476, .5)).M_c, 1.0892780700, 1e-10);
    EXPECT_NEAR(default_h_po(0.35), 0.53, 1e-12);
    EXPECT_NEAR(default_h_po(0.75), 0.63, 1e-12);
}

struct Initial {
    const char* material;
    double K0;
    double xi, M_b, M_d, A_do, z_max, G;
};

TEST(Pm4SandInitialState, IsThatOfTheTable) {
    const Initial rows[] = {{"tailings_cal", 1.0, 0.156363570, 1.068194361, 1.159583146, 1.24,
                             0.269687144, 47908.400933},
                            {"tailings_def", 1.0, -0.072620110, 1.129556650, 1.081396374,
                             1.256531300, 1.090141745, 47908.400933},
                            {"embankment", 1.0, -0.272620110, 1.248353160, 1.059983291, 1.302205381,
                             3.692514745, 68138.629059},
                            {"foundation", 1.0, -0.472620110, 1.379643608, 1.038994215, 1.359786930,
                             12.507240652, 89576.631997},
                            {"tailings_cal", 0.5, 0.137429004, 1.070725579, 1.150833839, 1.24,
                             0.302706416, 38372.190539},
                            {"foundation", 0.5, -0.486630861, 1.389342462, 1.037539526, 1.364429318,
                             13.623187525, 75519.307562}};
    for (const Initial& row : rows) {
        const Ready law = ready(soil(row.material));
        const State state = consolidated(law, 100.0, row.K0);
        const auto at = surfaces(law, state.p, law.parameters.D_R);
        EXPECT_NEAR(at.xi, row.xi, 1e-8);
        EXPECT_NEAR(at.M_b, row.M_b, 1e-8);
        EXPECT_NEAR(at.M_d, row.M_d, 1e-8);
        EXPECT_NEAR(state.A_do, row.A_do, 1e-8);
        EXPECT_NEAR(state.z_max, row.z_max, 1e-8);
        EXPECT_NEAR(state.G / 1e3, row.G, 1e-5);
        EXPECT_NEAR(state.p_min, 506.5, 1e-9);
        EXPECT_NEAR(state.M_cur, row.K0 == 1.0 ? 0.0 : 2.0 / 3.0, 1e-12);
    }
}

TEST(Pm4SandInitialState, KeepsAStressOutsideTheSurfacesAsAnOffset) {
    const Ready law = ready(soil("tailings_def"));
    for (const auto& [sigma_v, K0] : {std::pair{100.0, 0.2}, {0.3, 1.0}, {0.0, 1.0}, {-5.0, 1.0}}) {
        const State state = consolidated(law, sigma_v, K0);
        const mechanics::Voigt sigma = stress(law, state);
        EXPECT_NEAR(sigma[0], -1e3 * K0 * sigma_v, 1e-6);
        EXPECT_NEAR(sigma[1], -1e3 * sigma_v, 1e-6);
        EXPECT_GE(state.p, state.p_min);
        EXPECT_LE(stress_ratio(state.p, state.s, state.p_min), 1.2);
    }
}

/// A pure shear component as a deviator.
Plane xy(double a) { return {0.0, std::numbers::sqrt2 * a}; }

struct Check {
    State state;
    Point<double> at;
    Surfaces<double> surface;
    Flow<double> flow;
};

/// Evaluates everything at sigma (p, p, tau) [kPa] and alpha (0, 0, a).
Check evaluate(const Ready& law, State state, double p, double tau, double a) {
    Check check;
    check.state = state;
    Fixed<double> fixed = fixed_of<double>(state);
    prepare(law, fixed);
    const Plane s = xy(1e3 * tau);
    const Plane across = s - (1e3 * p) * xy(a);
    const double M_cur = stress_ratio(1e3 * p, s, state.p_min);
    const double G = shear_modulus(law, fixed, 1e3 * p, M_cur, state.M_b, state.M_b);
    check.at = {1e3 * p, xy(a), (1.0 / norm(across)) * across, state.z, G, M_cur};
    check.surface = surfaces(law, 1e3 * p, law.parameters.D_R);
    check.flow = flow(law, fixed, check.at, check.surface);
    return check;
}

TEST(Pm4SandFunctions, LooseContraction) {
    const Ready law = ready(soil("tailings_def"));
    const Check at = evaluate(law, consolidated(law, 100, 1), 100, 10.5, .1);
    EXPECT_NEAR(at.at.G / 1e3, 47879.783756, 1e-5);
    EXPECT_NEAR(at.flow.B, .650224743, 1e-8);
    EXPECT_NEAR(at.flow.h, 1741.702149, 1e-5);
    EXPECT_NEAR(at.flow.K_p / 1e3, 75499.855486, 1e-4);
    EXPECT_NEAR(at.flow.X_d, .616170285, 1e-8);
    EXPECT_NEAR(at.flow.D, .00763600495, 1e-10);
}

TEST(Pm4SandFunctions, DenseDilation) {
    const Ready law = ready(soil("foundation"));
    const Check at = evaluate(law, consolidated(law, 100, 1), 100, 60.5, .6);
    EXPECT_NEAR(at.at.G / 1e3, 63077.078155, 1e-5);
    EXPECT_NEAR(at.flow.B, .119956146, 1e-8);
    EXPECT_NEAR(at.flow.h, 1020.317676, 1e-5);
    EXPECT_NEAR(at.flow.K_p / 1e3, 8159.558393, 1e-4);
    EXPECT_NEAR(at.flow.D, -.164424551, 1e-8);
}

TEST(Pm4SandFunctions, DenseWithFabricOnTheRotatedSurface) {
    const Ready law = ready(soil("foundation"));
    State state = consolidated(law, 100, 1);
    const double z_max = state.z_max;
    state.z = xy(-.3 * z_max);
    state.alpha_app = {0, 0, -.3};
    state.alpha_true = xy(-.2);
    state.alpha_prev = xy(.5);
    state.z_in = xy(.2 * z_max);
    state.z_cum = 2 * z_max;
    state.z_peak = .8 * z_max;
    state.p_zp = 80e3;
    const Check at = evaluate(law, state, 50, 20.25, .4);
    EXPECT_NEAR(at.surface.xi, -.504134363, 1e-8);
    EXPECT_NEAR(at.surface.M_b, 1.401555004, 1e-8);
    EXPECT_NEAR(at.at.G / 1e3, 35746.409048, 1e-5);
    EXPECT_NEAR(at.flow.h, 1130.240181, 1e-5);
    EXPECT_NEAR(at.flow.K_p / 1e3, 15759.035084, 1e-4);
    EXPECT_NEAR(at.flow.D, .0126494479, 1e-9);
}

TEST(Pm4SandFunctions, LooseWithFabricUnderReversedShear) {
    const Ready law = ready(soil("tailings_def"));
    State state = consolidated(law, 100, 1);
    state.z = xy(-.2 * state.z_max);
    state.alpha_app = {0, 0, .1};
    state.alpha_true = xy(.12);
    state.alpha_prev = xy(-.2);
    state.z_cum = state.z_max;
    state.z_peak = .5 * state.z_max;
    state.p_zp = 60e3;
    const Check at = evaluate(law, state, 30, -1.65, -.05);
    EXPECT_LT(at.at.n.x, 0.0);
    EXPECT_NEAR(at.at.G / 1e3, 17492.887925, 1e-5);
    EXPECT_NEAR(at.flow.h, 1892.457217, 1e-5);
    EXPECT_NEAR(at.flow.K_p / 1e3, 28059.989018, 1e-4);
    EXPECT_NEAR(at.flow.D, .193388253, 1e-8);
}

TEST(Lanes, ElementaryFunctionsAreThoseOfTheLibrary) {
    double worst_exp = 0, worst_log = 0, worst_turn = 0;
    for (int i = -20000; i <= 20000; ++i) {
        const double x = i * 0.00173;
        worst_exp =
            std::max(worst_exp, std::abs(materials::lanes::exponential(x) / std::exp(x) - 1));
        const double y = std::exp(x);
        worst_log = std::max(worst_log, std::abs(materials::lanes::logarithm(y) - std::log(y)) /
                                            std::max(1.0, std::abs(x)));
        const auto turned = materials::lanes::turn(x);
        worst_turn = std::max({worst_turn, std::abs(turned.cosine - std::cos(x)),
                               std::abs(turned.sine - std::sin(x))});
    }
    std::printf("exp %.1e log %.1e turn %.1e (allowed 1e-15, 1e-15, 4e-15)\n", worst_exp, worst_log,
                worst_turn);
    EXPECT_LT(worst_exp, 1e-15);
    EXPECT_LT(worst_log, 1e-15);
    EXPECT_LT(worst_turn, 4e-15);
}

}  // namespace
}  // namespace breach::testing
