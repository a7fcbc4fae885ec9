// Stiff and extreme calls: no NaN, no endless loop; a call that cannot be integrated reports it and
// keeps the state. Also invariants of every call.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/materials/pm4sand/functions.hpp"
#include "tests/verification/pm4sand/soils.hpp"

namespace breach::testing {
namespace {

using namespace pm4sand;
using mechanics::Voigt;

const Options schemes[] = {{.scheme = Scheme::reference}, {.scheme = Scheme::adaptive}};

/// Invariants of every update.
void expect_sound(const Ready& law, const State& state) {
    const Voigt sigma = stress(law, state);
    ASSERT_TRUE(sigma.allFinite());
    ASSERT_TRUE(std::isfinite(state.G) && state.G > 0.0);
    ASSERT_GE(state.p, 0.0);
    ASSERT_LE(norm(state.z), state.z_max * (1.0 + 1e-2));
    ASSERT_LE(stress_ratio(state.p, state.s, state.p_min), state.M_b * (1.0 + 1e-9));
}

struct Tally {
    int calls = 0, unresolved = 0;
    long evaluations = 0;
    Counts counts;
};

/// One checked call; the state changes only if it was resolved.
void call(const Ready& law, const Options& options, const Voigt& d, State& state, Tally& tally) {
    const double z_cum = state.z_cum;
    const Update update = integrate(law, state, d, options);
    ++tally.calls;
    tally.evaluations += update.counts.evaluations;
    tally.counts += update.counts;
    if (update.outcome != Outcome::done) {
        ++tally.unresolved;
        ASSERT_EQ(std::memcmp(&update.state, &state, sizeof(State)), 0);
        return;
    }
    state = update.state;
    expect_sound(law, state);
    ASSERT_GE(state.z_cum, z_cum);
}

void report(const char* what, const Options& options, const Tally& tally) {
    std::printf(
        "%-34s %-9s calls %6d unresolved %3d evaluations per call %.1f forced %d softened "
        "%d stalled %d\n",
        what, options.scheme == Scheme::reference ? "reference" : "adaptive", tally.calls,
        tally.unresolved, static_cast<double>(tally.evaluations) / tally.calls, tally.counts.forced,
        tally.counts.softened, tally.counts.stalled);
}

TEST(Pm4SandExtremes, StrainThatIsNotANumberIsRefused) {
    const Ready law = ready(soil("tailings_def"));
    const State state = consolidated(law, 100.0, 0.5);
    for (const Options& options : schemes) {
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
            for (const int i : {0, 1, 3}) {
                Voigt d = Voigt::Zero();
                d[i] = bad;
                const Update update = integrate(law, state, d, options);
                EXPECT_EQ(update.outcome, Outcome::refused);
                EXPECT_EQ(std::memcmp(&update.state, &state, sizeof(State)), 0);
            }
        }
    }
}

TEST(Pm4SandExtremes, LooseDenseShallowDeepAndSkewedStatesShearInBigSteps) {
    for (const Options& options : schemes) {
        Tally tally;
        for (const double D_R : {0.05, 0.35, 0.99}) {
            for (const double sigma_v : {0.1, 100.0, 1e4}) {
                for (const double K0 : {0.2, 0.5, 1.0, 3.0}) {
                    const Ready law = ready(defaults(D_R, 400.0, default_h_po(D_R)));
                    State state = consolidated(law, sigma_v, K0);
                    for (const double d : {1e-5, 1e-3, -1e-2, 1e-2, -1e-4}) {
                        call(law, options, shear(d), state, tally);
                    }
                }
            }
        }
        report("densities, depths, K0", options, tally);
        EXPECT_EQ(tally.unresolved, 0);
    }
}

TEST(Pm4SandExtremes, PressureMayVanishAndComeBack) {
    const Ready law = ready(soil("tailings_def"));
    for (const Options& options : schemes) {
        Tally tally;
        State state = consolidated(law, 20.0, 0.5);
        for (int i = 0; i < 20; ++i) {  // swells more than the stress can follow
            call(law, options, Voigt(1e-4, 3e-4, 0.0, 2e-4), state, tally);
        }
        const double lowest = state.p;
        for (int i = 0; i < 40; ++i) {
            call(law, options, Voigt(-1e-4, -3e-4, 0.0, -1e-4), state, tally);
        }
        report("swelling to nothing and back", options, tally);
        std::printf("    lowest p %.3f kPa, p after %.3f kPa\n", lowest / 1e3, state.p / 1e3);
        EXPECT_LE(lowest, 2.0 * state.p_min);
        EXPECT_GT(state.p, 1e3);
        EXPECT_EQ(tally.unresolved, 0);
    }
}

/// In a folded mesh an element may report an eightfold volume: the formula's M_b is then below m,
/// and a projection onto it would rotate alpha endlessly.
TEST(Pm4SandExtremes, SoilThatHasExpandedWithoutLimitGoesOn) {
    const Ready law = ready(soil("embankment"));
    std::mt19937 random(1033);
    std::normal_distribution<double> normal;
    for (const Options& options : schemes) {
        Tally tally;
        State state = initialise(law, Voigt(-120.0, -120.0, 0.0, 0.5), -8.3);
        for (int i = 0; i < 2000; ++i) {
            const double size = std::pow(10.0, -6.0 + i % 3);
            call(law, options, size * Voigt(normal(random), normal(random), 0.0, normal(random)),
                 state, tally);
            ASSERT_GE(state.M_b, law.parameters.m);
        }
        report("opened by 8.3 times its volume", options, tally);
        EXPECT_EQ(tally.unresolved, 0);
    }
}

TEST(Pm4SandExtremes, ReversalEveryCall) {
    for (const char* name : {"tailings_def", "tailings_cal", "foundation"}) {
        const Ready law = ready(soil(name));
        for (const Options& options : schemes) {
            Tally tally;
            State state = consolidated(law, 100.0, 0.5);
            for (int i = 0; i < 4000; ++i) {
                call(law, options, shear(i % 2 ? -1e-4 : 1e-4), state, tally);
            }
            report(name, options, tally);
            EXPECT_EQ(tally.unresolved, 0);
        }
    }
}

TEST(Pm4SandExtremes, TenThousandCycles) {
    const Ready law = ready(soil("tailings_def"));
    const Options options{};
    Tally tally;
    State state = consolidated(law, 100.0, 0.5);
    for (int i = 0; i < 40000; ++i) {
        const int quarter = i % 4;
        call(law, options, shear(quarter == 0 || quarter == 3 ? 2e-4 : -2e-4), state, tally);
    }
    report("1e4 cycles of 2e-4", options, tally);
    EXPECT_EQ(tally.unresolved, 0);
}

TEST(Pm4SandExtremes, RandomDirectionsEndInAnAnswerOrInAFailure) {
    std::mt19937 random(4711);
    std::normal_distribution<double> normal;
    for (const char* name : {"tailings_cal", "tailings_def", "foundation"}) {
        const Ready law = ready(soil(name));
        for (const double size : {1e-5, 1e-4, 1e-3}) {
            Tally tally;
            State state = consolidated(law, 100.0, 0.5);
            int most = 0;
            for (int i = 0; i < 4000; ++i) {
                const double shear_part = size * normal(random), stretch = size * normal(random),
                             volume = 0.1 * size * normal(random);
                const long before = tally.evaluations;
                call(law, {}, Voigt(stretch + volume, -stretch + volume, 0.0, shear_part), state,
                     tally);
                most = std::max(most, static_cast<int>(tally.evaluations - before));
            }
            report(name, {}, tally);
            std::printf("    steps of %.0e: most evaluations in a call %d\n", size, most);
            EXPECT_LE(most, Options{}.most_evaluations + 4);
            EXPECT_LT(tally.unresolved, 40);
        }
    }
}

TEST(Pm4SandProperties, MirroredShearGivesMirroredStress) {
    const Ready law = ready(soil("tailings_def"));
    for (const Options& options : schemes) {
        State a = consolidated(law, 100.0, 1.0), b = a;
        for (const double d : {1e-3, 1e-3, -2e-3, 5e-4}) {
            a = integrate(law, a, shear(d), options).state;
            b = integrate(law, b, shear(-d), options).state;
        }
        EXPECT_NEAR(stress(law, a)[3], -stress(law, b)[3], 1e-6 * std::abs(stress(law, a)[3]));
        EXPECT_NEAR(a.p, b.p, 1e-6 * a.p);
    }
}

TEST(Pm4SandProperties, SmallStressReturnsWithTheYieldCone) {
    for (const Options& options : schemes) {
        const Ready law = ready(soil("foundation"));
        State state = consolidated(law, 100.0, 0.5);
        double worst = 0.0;
        for (int i = 0; i < 2000; ++i) {
            const double d = std::sin(0.01 * i) * 2e-5;
            state = integrate(law, state, Voigt(0.1 * d, -0.2 * d, 0.0, d), options).state;
            const double f =
                norm(state.s - state.p * state.alpha) - law.parameters.m * inverse_sqrt2 * state.p;
            worst = std::max(worst, f);
        }
        std::printf("largest f %.1e Pa (allowed 1e-4)\n", worst);
        EXPECT_LT(worst, 1e-4);
    }
}

}  // namespace
}  // namespace breach::testing
