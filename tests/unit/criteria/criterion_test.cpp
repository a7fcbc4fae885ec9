#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/criteria/window.hpp"

namespace breach::criteria {
namespace {

using State = Criterion::State;

Criterion criterion(const std::string& text, double hold) {
    return {parse(text, Kind::condition, ""), hold};
}

TEST(Criterion, WithoutHoldIsMetOnTheCrossingLine) {
    Criterion c = criterion("x > 1", 0);
    EXPECT_EQ(c.take({0.1, 1, {0.5}}), State::armed);
    EXPECT_EQ(c.take({0.2, 2, {1.5}}), State::met);
    EXPECT_DOUBLE_EQ(c.met_at(), 0.2);
    EXPECT_EQ(c.crossing()->step, 2);
    EXPECT_DOUBLE_EQ(c.crossing()->values[0], 1.5);
    EXPECT_EQ(c.take({0.3, 3, {0.0}}), State::met);  // once met, always met
}

TEST(Criterion, CrossedAndUncrossedInsideTheHoldIsArmedAgain) {
    Criterion c = criterion("x > 1", 0.05);
    EXPECT_EQ(c.take({0.10, 1, {2}}), State::holding);
    EXPECT_EQ(c.take({0.14, 2, {0}}), State::armed);
    EXPECT_FALSE(c.crossing());
    EXPECT_EQ(c.take({0.20, 3, {2}}), State::holding);  // the hold begins anew
    EXPECT_EQ(c.take({0.24, 4, {2}}), State::holding);
    EXPECT_EQ(c.take({0.25, 5, {2}}), State::met);  // 0.25 - 0.20 is a little less than 0.05
    EXPECT_DOUBLE_EQ(c.crossing()->time, 0.20);
    EXPECT_DOUBLE_EQ(c.met_at(), 0.25);
}

TEST(Criterion, TakesOfALineWhatItsExpressionAsksForAndNumbersThatStandBeside) {
    const Expression asked = parse("energy > 1 and depth > 2 and speed < 3", Kind::condition, "");
    const Line line = line_for(asked, {0.5, 3, {{"energy", 2}, {"speed", 1}}}, {{"speed", 7}});
    EXPECT_EQ(line.time, 0.5);
    EXPECT_EQ(line.step, 3);
    ASSERT_EQ(line.values.size(), 3u);
    EXPECT_EQ(line.values[0], 2.0);
    EXPECT_TRUE(std::isnan(line.values[1])) << "the line has no depth";
    EXPECT_EQ(line.values[2], 7.0);
}

TEST(Window, UpperEdgeBeforeTheLowerOneDoesNotCount) {
    Window w(parse("x > 1", Kind::condition, ""), parse("y < 1", Kind::condition, ""), 0);
    const auto take = [&](double t, double x, double y) {
        w.take_lower({t, 0, {x}});
        w.take_upper({t, 0, {y}});
    };
    take(0.1, 0, 0);
    EXPECT_EQ(w.upper().state(), State::armed);
    take(0.2, 2, 2);
    EXPECT_EQ(w.lower().state(), State::met);
    EXPECT_EQ(w.upper().state(), State::armed);
    take(0.3, 2, 0);
    EXPECT_EQ(w.upper().state(), State::met);
}

TEST(Window, IsNoneWhereTheMeshWasTooDistortedBeforeTheFailureHadDeveloped) {
    const auto shut_since = [](const std::vector<std::array<double, 3>>& lines, double hold) {
        Window w(parse("x > 1", Kind::condition, ""), parse("y < 1", Kind::condition, ""), hold);
        for (const auto& [t, x, y] : lines) {
            w.take_lower({t, 0, {x}});
            w.take_upper({t, 0, {y}});
        }
        return w.shut_since() ? w.shut_since()->time : -1.0;
    };
    EXPECT_EQ(shut_since({{1, 0, 2}, {2, 0, 0}, {3, 0, 0}, {4, 2, 0}, {5, 2, 0}}, 0), 2.0);
    EXPECT_EQ(shut_since({{1, 0, 2}, {2, 2, 0}}, 0), 2.0) << "on one line: of no length";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 0, 2}, {3, 2, 2}, {4, 2, 0}}, 0), -1.0)
        << "it was sound again when the failure had developed";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 0, 0}}, 0), -1.0) << "not known before the lower edge";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 2, 0}, {4, 2, 0}, {6, 2, 0}}, 2), 1.0);
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 2, 0}, {4, 2, 0}, {5, 2, 2}, {7, 2, 0}, {9, 2, 0}}, 2),
              -1.0)
        << "it did not last for the hold";
    EXPECT_EQ(shut_since({{1, 0, 2}, {2, 2, 2}, {3, 2, 0}, {4, 2, 0}, {6, 2, 0}}, 2), -1.0)
        << "after the lower edge: a short window";
}

TEST(Window, PicksAsAsked) {
    const std::vector<double> times{0.5, 1.0, 1.5, 2.0, 2.5};
    EXPECT_DOUBLE_EQ(*picked(Pick::first, 0.9, 2.0, times), 1.0);
    EXPECT_DOUBLE_EQ(*picked(Pick::last_before, 0.9, 2.0, times), 1.5);
    EXPECT_DOUBLE_EQ(*picked(Pick::last_before, 0.9, 2.1, times), 2.0);
    EXPECT_DOUBLE_EQ(*picked(Pick::midpoint, 0.9, 2.2, times), 1.5);
    EXPECT_DOUBLE_EQ(*picked(Pick::midpoint, 1.0, 1.5, times), 1.0);  // the earlier of two
    EXPECT_FALSE(picked(Pick::midpoint, 1.1, 1.4, times));
    EXPECT_FALSE(picked(Pick::last_before, 1.0, 1.0, times));
}

}  // namespace
}  // namespace breach::criteria
