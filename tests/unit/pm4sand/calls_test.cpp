// The default scheme along a strain path: results do not depend on the division into calls, nor
// reversals on the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "tests/verification/pm4sand/soils.hpp"

namespace breach::testing {
namespace {

using namespace pm4sand;
using mechanics::Voigt;

/// Ten cycles of shear of 1e-3 while the compression axes oscillate at another frequency:
/// components reverse at different times.
Voigt strain_at(double cycle) {
    const double turn = 2.0 * std::numbers::pi * cycle;
    const double shear = 1e-3 * (0.3 + 0.7 * std::min(1.0, cycle / 5.0)) * std::sin(turn);
    const double swing = 3.5e-4 * (std::sin(1.37 * turn + 0.4) - std::sin(0.4));
    return {swing, -swing, 0.0, shear};
}

/// Mean stress along the path [kPa]: `parts` straight pieces per cycle, each in `calls` calls.
std::vector<double> course(int parts, int calls) {
    const Ready law = ready(soil("tailings_cal"));
    State state = consolidated(law, 100.0, 0.5);
    std::vector<double> p;
    Voigt last = strain_at(0.0);
    for (int i = 1; i <= 10 * parts; ++i) {
        const Voigt now = strain_at(static_cast<double>(i) / parts);
        for (int k = 0; k < calls; ++k) {
            const Update update = integrate(law, state, (now - last) / calls, {});
            EXPECT_EQ(update.outcome, Outcome::done);
            state = update.state;
        }
        last = now;
        p.push_back(state.p / 1e3);
    }
    return p;
}

TEST(Pm4SandCalls, PathDoesNotDependOnHowItIsCut) {
    const std::vector<double> fine = course(64, 32);
    for (const int calls : {1, 4}) {
        const std::vector<double> usual = course(64, calls);
        double worst = 0.0;
        for (std::size_t i = 0; i < fine.size(); ++i)
            worst = std::max(worst, std::abs(usual[i] - fine[i]));
        std::printf("%2d calls a piece: p differs by at most %.3f kPa (allowed 0.1)\n", calls,
                    worst);
        EXPECT_LT(worst, 0.1);
    }
    // A curve of 32 pieces a cycle is nearly that of 64.
    EXPECT_NEAR(course(32, 1).back() / fine.back(), 1.0, 0.03);
}

/// Number of calls in random directions that change alpha_in^true.
int reversals(double tolerance) {
    const Ready law = ready(soil("tailings_def"));
    State state = consolidated(law, 100.0, 0.5);
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    int count = 0;
    Voigt held = Voigt::Zero();
    for (int i = 0; i < 4000; ++i) {
        const Voigt d(1e-5 * normal(random), 1e-5 * normal(random), 0.0, 1e-4 * normal(random));
        // Oscillates about its beginning, so that the state stays realistic.
        const Plane before = state.alpha_true;
        state = integrate(law, state, d - 0.1 * held, {.tolerance = tolerance}).state;
        held += d - 0.1 * held;
        count += std::memcmp(&before, &state.alpha_true, sizeof before) != 0;
    }
    return count;
}

TEST(Pm4SandCalls, ReversalsDoNotDependOnTheTolerance) {
    const int usual = reversals(1e-5);
    EXPECT_GT(usual, 100);
    for (const double tolerance : {1e-4, 1e-6, 1e-7}) {
        const int count = reversals(tolerance);
        std::printf("tolerance %.0e: %d reversals, %d at 1e-5\n", tolerance, count, usual);
        EXPECT_NEAR(count, usual, 0.02 * usual);
    }
}

}  // namespace
}  // namespace breach::testing
