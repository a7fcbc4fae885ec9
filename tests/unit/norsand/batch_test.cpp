// Points side by side give the results of single points: the same bits, in any order, for every
// width.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/verification/norsand/soils.hpp"

namespace breach::testing {
namespace {

using namespace norsand;
using mechanics::Voigt;

template <class T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}
bool same(const Update& a, const Update& b) {
    const State &x = a.state, &y = b.state;
    return same_bits(x.xx, y.xx) && same_bits(x.yy, y.yy) && same_bits(x.zz, y.zz) &&
           same_bits(x.xy, y.xy) && same_bits(x.p_i, y.p_i) && same_bits(x.e, y.e) &&
           same_bits(x.epsilon_q, y.epsilon_q) && same_bits(x.sub_step, y.sub_step) &&
           x.on_floor == y.on_floor && x.has_fallen == y.has_fallen && a.outcome == b.outcome &&
           same_bits(a.counts, b.counts);
}

/// A zone of points with different histories, and strains from tiny to large, one of them NaN.
struct Zone {
    Ready law;
    std::vector<State> states;
    std::vector<Voigt> strain;
};

Zone zone(const char* name, FlowRule rule, double S) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Parameters parameters = soil(name);
    parameters.flow = rule;
    parameters.S = S;
    Zone out{ready(parameters), {}, {}};
    for (int k = 0; k < 203; ++k) {
        const double sigma_v = 1e3 * (20.0 + k), K0 = k % 3 ? 0.6 : 1.0;
        const double p = (1.0 + 2.0 * K0) / 3.0 * sigma_v;
        State state =
            initialise(out.law, Voigt(-K0 * sigma_v, -sigma_v, -K0 * sigma_v, 0.0),
                       -0.06 + 0.0005 * k + critical_void_ratio(out.law, p), 1.0 + 0.1 * (k % 2))
                .state;
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
    out.strain[19][0] = 0.2;
    return out;
}

TEST(NorSandBatch, AnswersAsSingleCallsDoToTheLastBit) {
    for (const char* name : {"CJ1", "CJ2", "TC"}) {
        for (const FlowRule rule : {FlowRule::js, FlowRule::radial, FlowRule::normal}) {
            const Zone points = zone(name, rule, rule == FlowRule::js ? 1.0 : 0.0);
            const std::size_t n = points.states.size();
            std::vector<Update> alone(n);
            int plastic = 0, done = 0;
            for (std::size_t k = 0; k < n; ++k) {
                alone[k] = integrate(points.law, points.states[k], points.strain[k], {});
                plastic += alone[k].counts.sub_steps > 0;
                done += alone[k].outcome == Outcome::done;
            }
            EXPECT_GT(plastic, 40) << name;
            EXPECT_GT(done, 195) << name;
            EXPECT_EQ(alone[17].outcome, Outcome::refused);
            EXPECT_EQ(alone[19].outcome, Outcome::refused);
            for (const Width width : {Width::portable, Width::avx2, Width::avx512}) {
                std::vector<Update> updates(n);
                integrate(points.law, points.states, points.strain, {}, updates, width);
                int different = 0;
                for (std::size_t k = 0; k < n; ++k) different += !same(alone[k], updates[k]);
                EXPECT_EQ(different, 0) << name;
            }
            // In reverse order.
            std::vector<State> states(points.states.rbegin(), points.states.rend());
            std::vector<Voigt> strain(points.strain.rbegin(), points.strain.rend());
            std::vector<Update> updates(n);
            integrate(points.law, states, strain, {}, updates);
            int different = 0;
            for (std::size_t k = 0; k < n; ++k) different += !same(alone[n - 1 - k], updates[k]);
            EXPECT_EQ(different, 0) << name;
        }
    }
}

TEST(NorSandBatch, TakesNoPointsAndFewerThanAreSideBySide) {
    const Zone points = zone("CJ1", FlowRule::js, 0.0);
    std::vector<Update> none;
    integrate(points.law, {}, {}, {}, none);
    for (std::size_t n = 1; n < 9; ++n) {
        std::vector<Update> updates(n);
        integrate(points.law, std::span(points.states).first(n), std::span(points.strain).first(n),
                  {}, updates);
        for (std::size_t k = 0; k < n; ++k)
            EXPECT_TRUE(
                same(updates[k], integrate(points.law, points.states[k], points.strain[k], {})));
    }
}

}  // namespace
}  // namespace breach::testing
