// Points side by side give the results of single points: the same bits, in any order, for every
// width.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/verification/pm4sand/soils.hpp"

namespace breach::testing {
namespace {

using namespace pm4sand;
using mechanics::Voigt;

bool same(const Update& a, const Update& b) {
    return std::memcmp(&a.state, &b.state, sizeof(State)) == 0 && a.outcome == b.outcome &&
           std::memcmp(&a.counts, &b.counts, sizeof(Counts)) == 0;
}

/// A zone of points with different histories, and strains from tiny to large, one of them NaN.
struct Zone {
    Ready law;
    std::vector<State> states;
    std::vector<Voigt> strain;
};

Zone zone(const std::string& name) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Zone out{ready(soil(name)), {}, {}};
    for (int k = 0; k < 203; ++k) {
        State state = consolidated(out.law, 20.0 + k, k % 3 ? 0.5 : 1.0);
        for (int i = 0; i < 20; ++i) {
            const Voigt d(1e-5 * normal(random), 1e-5 * normal(random), 0.0, 3e-4 * normal(random));
            state = integrate(out.law, state, d, {}).state;
        }
        out.states.push_back(state);
        const double size = std::pow(10.0, -6.0 + k % 4);
        out.strain.push_back(Voigt(0.1 * size * normal(random), 0.1 * size * normal(random), 0.0,
                                   size * normal(random)));
    }
    out.strain[17][3] = std::nan("");
    out.strain[18].setZero();
    return out;
}

TEST(Pm4SandBatch, AnswersAsSingleCallsDoToTheLastBit) {
    for (const char* name : {"tailings_cal", "tailings_def", "foundation"}) {
        const Zone points = zone(name);
        const std::size_t n = points.states.size();
        for (const Width width : {Width::portable, Width::avx2, Width::avx512}) {
            std::vector<Update> updates(n);
            integrate(points.law, points.states, points.strain, {}, updates, width);
            int different = 0;
            for (std::size_t k = 0; k < n; ++k) {
                const Update alone = integrate(points.law, points.states[k], points.strain[k], {});
                different += !same(alone, updates[k]);
            }
            EXPECT_EQ(different, 0) << name << " width " << static_cast<int>(width);
        }
    }
}

TEST(Pm4SandBatch, DoesNotDependOnTheOrderOfPointsNorOnRepetition) {
    const Zone points = zone("tailings_def");
    const std::size_t n = points.states.size();
    std::vector<Update> forward(n), again(n), backward(n);
    integrate(points.law, points.states, points.strain, {}, forward);
    integrate(points.law, points.states, points.strain, {}, again);
    const std::vector<State> states(points.states.rbegin(), points.states.rend());
    const std::vector<Voigt> strain(points.strain.rbegin(), points.strain.rend());
    integrate(points.law, states, strain, {}, backward);
    for (std::size_t k = 0; k < n; ++k) {
        EXPECT_TRUE(same(forward[k], again[k]));
        EXPECT_TRUE(same(forward[k], backward[n - 1 - k]));
    }
}

}  // namespace
}  // namespace breach::testing
