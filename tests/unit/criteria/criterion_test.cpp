#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

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
    EXPECT_EQ(c.take({0.3, 3, {0.0}}), State::met);  // a met criterion stays met
}

TEST(Criterion, CrossedAndUncrossedInsideTheHoldIsArmedAgain) {
    Criterion c = criterion("x > 1", 0.05);
    EXPECT_EQ(c.take({0.10, 1, {2}}), State::holding);
    EXPECT_EQ(c.take({0.14, 2, {0}}), State::armed);
    EXPECT_FALSE(c.crossing());
    EXPECT_EQ(c.take({0.20, 3, {2}}), State::holding);  // the hold starts again
    EXPECT_EQ(c.take({0.24, 4, {2}}), State::holding);
    EXPECT_EQ(c.take({0.25, 5, {2}}), State::met);  // 0.25 - 0.20 is slightly less than 0.05
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

TEST(Criterion, FollowedItIsMetOnlyWhileItsConditionIsTrue) {
    Criterion c = criterion("x > 1", 0.2);
    EXPECT_EQ(c.follow({1.0, 1, {2}}), State::holding);
    EXPECT_EQ(c.follow({1.2, 2, {2}}), State::met);
    EXPECT_EQ(c.follow({1.4, 3, {2}}), State::met);
    EXPECT_DOUBLE_EQ(c.crossing()->time, 1.0);
    EXPECT_DOUBLE_EQ(c.met_at(), 1.2);
    EXPECT_EQ(c.follow({1.6, 4, {0}}), State::armed);
    EXPECT_FALSE(c.crossing());
}

/// Time, x (the failure has developed above 1) and y (the mesh is too distorted below 1).
using Course = std::vector<std::array<double, 3>>;

Window window(double hold) {
    return {parse("x > 1", Kind::condition, ""), parse("y < 1", Kind::condition, ""), hold};
}

void show(Window& w, const std::array<double, 3>& line) {
    w.take_lower({line[0], 0, {line[1]}});
    w.take_upper({line[0], 0, {line[2]}});
}

Window window_of(const Course& course, double hold) {
    Window w = window(hold);
    for (const auto& line : course) show(w, line);
    return w;
}

double time_of(const std::optional<Line>& line) { return line ? line->time : -1.0; }

double shut_since(const Course& course, double hold) {
    return time_of(window_of(course, hold).shut_since());
}

double upper_edge(const Course& course, double hold) {
    return time_of(window_of(course, hold).upper_edge());
}

/// Lines 0.1 s apart, over [0, end]; x and y exceed their levels in these intervals, ends included.
Course course_of(double end, const std::vector<std::array<double, 2>>& lower,
                 const std::vector<std::array<double, 2>>& upper) {
    Course course;
    const auto inside = [](double t, const auto& spans) {
        return std::ranges::any_of(
            spans, [&](const auto& each) { return t > each[0] - 1e-6 && t < each[1] + 1e-6; });
    };
    for (int i = 0; 0.1 * i < end + 1e-6; ++i)
        course.push_back(
            {0.1 * i, inside(0.1 * i, lower) ? 2.0 : 0.0, inside(0.1 * i, upper) ? 0.0 : 2.0});
    return course;
}

TEST(Window, UpperEdgeBeforeTheLowerOneDoesNotCount) {
    Window w = window(0);
    show(w, {0.1, 0, 0});
    show(w, {0.2, 2, 2});
    EXPECT_EQ(w.lower().state(), State::met);
    EXPECT_FALSE(w.upper_edge());
    show(w, {0.3, 2, 0});
    EXPECT_EQ(time_of(w.upper_edge()), 0.3);
}

TEST(Window, IsNoneWhereTheMeshWasTooDistortedBeforeTheFailureHadDeveloped) {
    EXPECT_EQ(shut_since({{1, 0, 2}, {2, 0, 0}, {3, 0, 0}, {4, 2, 0}, {5, 2, 0}}, 0), 2.0);
    EXPECT_EQ(shut_since({{1, 0, 2}, {2, 2, 0}}, 0), 2.0) << "on one line: of no length";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 0, 2}, {3, 2, 2}, {4, 2, 0}}, 0), -1.0)
        << "it was sound again when the failure had developed";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 0, 0}}, 0), -1.0) << "not known before the lower edge";
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 2, 0}, {4, 2, 0}, {6, 2, 0}}, 2), 1.0);
    EXPECT_EQ(shut_since({{1, 0, 0}, {2, 2, 0}, {4, 2, 0}, {5, 2, 2}, {7, 2, 0}, {9, 2, 0}}, 2),
              1.0)
        << "it lasted for the hold, and that the mesh came to itself later is no window";
    const Course too_short{{1, 0, 0}, {2, 2, 0}, {2.5, 2, 2}, {4, 2, 2}, {7, 2, 0}, {9, 2, 0}};
    EXPECT_EQ(shut_since(too_short, 2), -1.0) << "it did not last for the hold";
    EXPECT_EQ(upper_edge(too_short, 2), 7.0);
    const Course after{{1, 0, 2}, {2, 2, 2}, {3, 2, 0}, {4, 2, 0}, {6, 2, 0}};
    EXPECT_EQ(shut_since(after, 2), -1.0) << "after the lower edge: a short window";
    EXPECT_EQ(upper_edge(after, 2), 3.0) << "where it began, not where the lower edge was met";
}

TEST(Window, TheHoldOfTheUpperEdgeRunsFromItsOwnBeginning) {
    const Course during = course_of(9, {{5.0, 9}}, {{5.4, 9}});
    EXPECT_NEAR(upper_edge(during, 1), 5.4, 1e-9) << "within the hold of the lower edge";
    EXPECT_EQ(shut_since(during, 1), -1.0);
    const Course before = course_of(6.5, {{5.0, 9}}, {{4.8, 9}});
    EXPECT_NEAR(shut_since(before, 1), 4.8, 1e-9);
    EXPECT_EQ(upper_edge(before, 1), -1.0) << "there is none";
    EXPECT_NEAR(shut_since(course_of(6, {{5, 9}}, {{5, 9}}), 1), 5.0, 1e-9) << "on one line";
    EXPECT_NEAR(shut_since(course_of(9, {{5, 9}}, {{3, 5.0}}), 1), 3.0, 1e-9)
        << "true on the line of the lower edge, after its hold";
    EXPECT_NEAR(upper_edge(course_of(9, {{5, 9}}, {{3, 4.9}, {7, 9}}), 1), 7.0, 1e-9)
        << "sound again on the line of the lower edge";
    EXPECT_NEAR(upper_edge(course_of(9, {{5, 9}}, {{4.9, 5.3}, {5.5, 5.8}, {6.2, 9}}), 1), 6.2,
                1e-9)
        << "spans that do not last are none";
    EXPECT_NEAR(upper_edge(course_of(9, {{5, 9}}, {{5.2, 6.2}}), 1), 5.2, 1e-9)
        << "over when the lower edge is met or soon after";
}

TEST(Window, ALowerConditionThatIsBrokenInItsHoldLeavesNothingBehind) {
    const std::vector<std::array<double, 2>> lower{{3, 3.8}, {6, 9}};
    EXPECT_NEAR(upper_edge(course_of(9, lower, {{2.5, 4}, {7, 9}}), 1), 7.0, 1e-9);
    EXPECT_NEAR(shut_since(course_of(9, lower, {{2.5, 9}}), 1), 2.5, 1e-9);
    EXPECT_NEAR(upper_edge(course_of(9, {{3, 3.8}, {4, 9}}, {{2.7, 3.9}, {5.5, 9}}), 1), 5.5, 1e-9)
        << "too distorted at a beginning of the failure that came to nothing";
}

TEST(Window, IsKnownToBeShutOnTheLineOnWhichTheLowerEdgeIsMet) {
    const Course course = course_of(6.0, {{5.0, 9}}, {{4.8, 9}});
    Window w = window(1);
    for (const auto& line : course) {
        EXPECT_FALSE(w.shut_since());
        show(w, line);
        EXPECT_EQ(w.lower().state() == State::met, w.shut_since().has_value()) << line[0];
    }
    EXPECT_TRUE(w.shut_since());
}

TEST(Window, KnowsTheTimesBeforeTheUpperEdgeForAnyLaterLines) {
    const std::vector<std::array<double, 2>> lower{{5.0, 9}};
    EXPECT_TRUE(window_of(course_of(6.2, lower, {}), 1).is_open_at(6.2));
    EXPECT_FALSE(window_of(course_of(6.2, lower, {}), 1).is_open_at(6.3)) << "not read yet";
    const Window running = window_of(course_of(6.2, lower, {{5.4, 9}}), 1);
    EXPECT_TRUE(running.is_open_at(5.3));
    EXPECT_FALSE(running.is_open_at(5.5)) << "it may last for its hold";
    EXPECT_FALSE(running.upper_edge());
    EXPECT_TRUE(window_of(course_of(6.2, lower, {{5.4, 6.0}}), 1).is_open_at(5.5))
        << "it did not last";
    const Window closed = window_of(course_of(6.5, lower, {{5.4, 6.4}}), 1);
    EXPECT_TRUE(closed.is_open_at(5.3));
    EXPECT_FALSE(closed.is_open_at(5.4));
    EXPECT_FALSE(closed.is_open_at(5.5)) << "the edge stays where it was";
}

/// The edges as window.hpp defines them, from all lines at once.
struct Edges {
    double lower = -1.0, upper = -1.0, shut = -1.0;
};

Edges edges_by_definition(const Course& course, double hold) {
    const auto first_from = [&](double from, const auto& is_true) {
        double began = -1.0;
        for (const auto& line : course) {
            if (!is_true(line)) {
                began = -1.0;
                continue;
            }
            if (began < 0.0) began = line[0];
            if (line[0] > from - 1e-6 && line[0] - began > hold - 1e-6) return began;
        }
        return -1.0;
    };
    const auto failed = [](const auto& line) { return line[1] > 1.0; };
    const auto distorted = [](const auto& line) { return line[2] < 1.0; };
    Edges edges;
    edges.lower = first_from(0.0, failed);
    if (edges.lower < 0.0) return edges;
    const double began = first_from(edges.lower, distorted);
    (began > edges.lower ? edges.upper : edges.shut) = began;
    return edges;
}

TEST(Window, IsThatOfItsDefinitionAndNoSnapshotIsCalledSoundTooEarly) {
    std::mt19937 random(7);
    for (int round = 0; round < 2000; ++round) {
        const double hold = 0.1 * static_cast<double>(random() % 5);
        bool failed = false, distorted = false;
        Course course;
        for (int i = 1; i <= 40; ++i) {
            if (random() % 5 == 0) failed = !failed;
            if (random() % 4 == 0) distorted = !distorted;
            course.push_back({0.1 * i, failed ? 2.0 : 0.0, distorted ? 0.0 : 2.0});
        }
        const Edges edges = edges_by_definition(course, hold);
        const Window all = window_of(course, hold);
        ASSERT_EQ(time_of(all.upper_edge()), edges.upper) << round;
        ASSERT_EQ(time_of(all.shut_since()), edges.shut) << round;
        Window w = window(hold);
        std::vector<bool> sound(course.size(), false);
        for (const auto& line : course) {
            show(w, line);
            if (w.lower().state() != State::met || w.shut_since()) continue;
            for (std::size_t i = 0; i < course.size(); ++i) {
                if (course[i][0] < edges.lower - 1e-6) continue;
                const bool now = w.is_open_at(course[i][0]);
                ASSERT_TRUE(now || !sound[i]) << round << ": it was sound before";
                sound[i] = now;
                ASSERT_TRUE(!now || edges.upper < 0.0 || course[i][0] < edges.upper) << round;
            }
        }
    }
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
