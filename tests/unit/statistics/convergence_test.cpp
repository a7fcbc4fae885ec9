// The statistics of an accuracy study against closed forms.
#include "core/statistics/convergence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace breach::statistics::convergence_test {
namespace {

Rung rung(double size, double value, std::optional<double> deviation = {}, std::size_t count = 1) {
    return {.size = size, .value = {.mean = value, .deviation = deviation, .count = count}};
}

/// limit + C size^p, exactly.
std::vector<Rung> power_law(double limit, double C, double p, const std::vector<double>& sizes) {
    std::vector<Rung> rungs;
    for (const double h : sizes) rungs.push_back(rung(h, limit + C * std::pow(h, p)));
    return rungs;
}

TEST(Convergence, FindsOrderAndLimitOfAPowerLaw) {
    for (const double p : {0.5, 1.0, 1.7, 2.0, 4.0}) {
        for (const std::vector<double>& sizes :
             {std::vector{4.0, 2.0, 1.0}, std::vector{5.0, 3.0, 2.5}, std::vector{1.0, 0.9, 0.3}}) {
            const Convergence found = convergence_of(power_law(40.0, -3.0, p, sizes));
            ASSERT_EQ(found.course, Course::monotone) << p;
            EXPECT_NEAR(*found.order, p, 1e-6);
            EXPECT_NEAR(*found.limit, 40.0, 1e-6);
        }
    }
}

TEST(Convergence, IndexIsRoachesWithHisFactorForThreeGrids) {
    // Halved twice, second order: 1.25 |f_2 - f_1| / (f_1 (2^2 - 1)).
    const auto rungs = power_law(10.0, 0.4, 2.0, {4.0, 2.0, 1.0});
    const double f_1 = 10.4;
    const double f_2 = 11.6;
    EXPECT_NEAR(*convergence_of(rungs).gci, 1.25 * (f_2 - f_1) / (3.0 * f_1), 1e-9);
}

TEST(Convergence, AnOrderThatNoSchemeHasIsNotReliedOn) {
    const auto rungs = power_law(10.0, 0.01, 4.0, {4.0, 2.0, 1.0});  // 12.56, 10.16, 10.01
    const Convergence found = convergence_of(rungs);
    EXPECT_NEAR(*found.order, 4.0, 1e-9);
    EXPECT_NEAR(*found.limit, 10.0, 1e-9);
    EXPECT_NEAR(*found.gci, 1.25 * 0.15 / (3.0 * 10.01), 1e-9) << "as of second order";
}

TEST(Convergence, SaysWhatTheOrderCouldBeByTheNoise) {
    // Runouts with 25, 36 and 64 points per cell, eight repeats each.
    const std::array near{rung(8, 191.9, 2.16, 8), rung(6.667, 193.6, 2.16, 8),
                          rung(5, 196.0, 2.16, 8)};
    const Convergence open = convergence_of(near);
    ASSERT_TRUE(open.order);
    EXPECT_EQ(open.order_by_noise->low, 0.0);
    EXPECT_GT(open.order_by_noise->high, 4.0);
    // Differences of 4 and 2 with an error of 1 each: 3 to 3 gives no order, 5 to 1 gives 2.32.
    const double deviation = 4.0;
    const Convergence known = convergence_of(std::array{
        rung(4, 16.0, deviation, 32), rung(2, 12.0, deviation, 32), rung(1, 10.0, deviation, 32)});
    EXPECT_EQ(known.order_by_noise->low, 0.0);
    EXPECT_NEAR(known.order_by_noise->high, std::log2(5.0), 1e-9);
    EXPECT_FALSE(convergence_of(power_law(10.0, 0.4, 2.0, {4.0, 2.0, 1.0})).order_by_noise)
        << "one run each says nothing of noise";
}

TEST(Convergence, OnlyTheThreeFinestRungsCount) {
    auto rungs = power_law(10.0, 0.4, 2.0, {4.0, 2.0, 1.0});
    rungs.insert(rungs.begin(), rung(8.0, -100.0));
    EXPECT_NEAR(*convergence_of(rungs).order, 2.0, 1e-9);
    EXPECT_NEAR(*convergence_of(rungs).spread, 116.4, 1e-9) << "the spread is that of all";
}

TEST(Convergence, OscillatingRungsGetASpreadAndNoOrder) {
    const Convergence found =
        convergence_of(std::array{rung(4, 10.0), rung(2, 12.0), rung(1, 11.0)});
    EXPECT_EQ(found.course, Course::oscillating);
    EXPECT_FALSE(found.order || found.limit || found.gci);
    EXPECT_DOUBLE_EQ(*found.spread, 2.0);
    EXPECT_DOUBLE_EQ(*found.error_of_finest, 1.0 / 11.0) << "half of the range";
}

TEST(Convergence, DifferencesThatDoNotFallGiveNoOrder) {
    EXPECT_EQ(convergence_of(std::array{rung(4, 10.0), rung(2, 11.0), rung(1, 13.0)}).course,
              Course::not_falling);
    EXPECT_EQ(convergence_of(std::array{rung(4, 10.0), rung(2, 11.0), rung(1, 12.0)}).course,
              Course::not_falling)
        << "equal differences are a logarithm of the size: no limit";
    EXPECT_EQ(convergence_of(std::array{rung(4, 10.0), rung(2, 11.0), rung(1, 11.0)}).course,
              Course::not_falling);
}

TEST(Convergence, WithoutAnOrderTheFinestIsOffByTheIndexForTwoGrids) {
    const auto three = std::array{rung(4, 10.0), rung(2, 11.0), rung(1, 13.0)};
    EXPECT_DOUBLE_EQ(*convergence_of(three).error_of_finest, 3.0 * 2.0 / 13.0);
    const auto two = std::array{rung(1.5, 10.0), rung(1, 11.0)};
    EXPECT_DOUBLE_EQ(*convergence_of(two).error_of_finest, 3.0 * 1.0 / 0.5 / 11.0);
    EXPECT_FALSE(convergence_of(two).gci);
}

/// If the course does not use sizes, the error of the finest rung does not depend on them.
TEST(Convergence, SizesDoNotMatterWhereTheCourseRestsOnNone) {
    const auto with_middle = [](double middle, const std::array<double, 3>& values) {
        return convergence_of(
            std::array{rung(4, values[0]), rung(middle, values[1]), rung(1, values[2])});
    };
    const struct {
        std::array<double, 3> values;
        Course course;
    } cases[]{{{10.0, 12.0, 11.0}, Course::oscillating},
              {{10.0, 10.0, 10.0}, Course::no_effect},
              {{10.0, 11.0, 13.0}, Course::not_falling},
              {{14.0, 11.0, 10.0}, Course::monotone}};
    for (const auto& [values, course] : cases) {
        const Convergence near = with_middle(1.9, values);
        const Convergence far = with_middle(2.0, values);
        EXPECT_EQ(near.course, course);
        EXPECT_EQ(far.course, course);
        EXPECT_EQ(*near.error_of_finest != *far.error_of_finest, rests_on_sizes(course))
            << name_of(course);
    }
    EXPECT_TRUE(rests_on_sizes(Course::too_few) && rests_on_sizes(Course::below_noise));
}

TEST(Convergence, TwoRungsHaveNoOrder) {
    EXPECT_EQ(convergence_of(std::array{rung(2, 10.0), rung(1, 11.0)}).course, Course::too_few);
    EXPECT_EQ(convergence_of({}).course, Course::too_few);
}

TEST(Convergence, ADifferenceBelowTheNoiseGivesNoOrder) {
    // Differences 3 and 1; the mean of 4 runs that scatter by 1, with 9 degrees of freedom, differs
    // significantly from 2.262 / sqrt 2 on (Student's 97.5 %).
    const auto with_noise = [](double deviation) {
        return convergence_of(std::array{rung(4, 14.0, deviation, 4), rung(2, 11.0, deviation, 4),
                                         rung(1, 10.0, deviation, 4)});
    };
    EXPECT_EQ(with_noise(1.0).course, Course::below_noise);
    EXPECT_FALSE(with_noise(1.0).order);
    EXPECT_DOUBLE_EQ(with_noise(1.0).noise->deviation, 1.0);
    EXPECT_EQ(with_noise(1.0).noise->freedom, 9u);
    EXPECT_EQ(with_noise(0.6).course, Course::monotone);
    EXPECT_NEAR(smallest_told_difference({1.0, 9}, 4), 2.262 / std::sqrt(2.0), 3e-3);
    EXPECT_NEAR(smallest_told_difference({1.0, 100000}, 4), 1.96 / std::sqrt(2.0), 1e-3);
}

TEST(Convergence, TwoRungsWithinTheNoiseAreOffByTheirDifference) {
    const std::array rungs{rung(2, 10.4, 1.0, 4), rung(1, 10.0, 1.0, 4)};
    EXPECT_EQ(convergence_of(rungs).course, Course::below_noise);
    EXPECT_NEAR(*convergence_of(rungs).error_of_finest, 0.04, 1e-12);
    const std::array apart{rung(2, 10.4, 0.1, 4), rung(1, 10.0, 0.1, 4)};
    EXPECT_EQ(convergence_of(apart).course, Course::too_few);
    EXPECT_NEAR(*convergence_of(apart).error_of_finest, 0.12, 1e-12) << "Roache's for two";
}

TEST(Convergence, RungsThatAreNearAgreeAtAnyError) {
    // 10 + 4 h: rungs at 1.25 and 1 differ by 1 and have an error of 4, hidden by a noise of 1.
    const std::array near{rung(1.25, 15.0, 1.0, 3), rung(1, 14.0, 1.0, 3)};
    EXPECT_EQ(convergence_of(near).course, Course::below_noise);
    EXPECT_NEAR(*convergence_of(near).error_of_finest, 4.0 / 14.0, 1e-12);
    const std::array far{rung(4, 15.0, 1.0, 3), rung(1, 14.0, 1.0, 3)};
    EXPECT_NEAR(*convergence_of(far).error_of_finest, 1.0 / 14.0, 1e-12) << "not less for that";
    // A third rung of twice the size: the noise of close rungs is not extrapolated.
    const std::array wide{rung(2, 13.9, 1.0, 3), rung(1.25, 15.0, 1.0, 3), rung(1, 14.0, 1.0, 3)};
    EXPECT_NEAR(*convergence_of(wide).error_of_finest, 1.0 / 14.0, 1e-12);
    const std::array apart{rung(2, 24.0, 1.0, 3), rung(1.25, 15.0, 1.0, 3), rung(1, 14.0, 1.0, 3)};
    EXPECT_NEAR(*convergence_of(apart).error_of_finest, 4.0 / 14.0, 1e-12);
}

TEST(Shares, AddUpAboveTheNoiseAndAsSquaresWithinIt) {
    EXPECT_DOUBLE_EQ(sum_of(std::array{Share{0.02, true}, Share{0.01, true}}), 0.03);
    EXPECT_DOUBLE_EQ(sum_of(std::array{Share{0.03, false}, Share{0.04, false}}), 0.05);
    EXPECT_DOUBLE_EQ(sum_of(std::array{Share{0.03, false}, Share{0.02, true}, Share{0.04, false}}),
                     0.07);
    EXPECT_DOUBLE_EQ(sum_of({}), 0.0);
}

TEST(Convergence, CoarseRungsThatScatterDoNotAffectTheFineOnes) {
    // 10 + h at 8, 4, 2, 1: the coarsest scatters more than the finest differ.
    std::vector<Rung> rungs;
    for (const double h : {8.0, 4.0, 2.0, 1.0})
        rungs.push_back({h, Repeats{10.0 + h, h > 4.0 ? 20.0 : 0.1, 3}});
    const Convergence found = convergence_of(rungs);
    EXPECT_EQ(found.course, Course::monotone);
    EXPECT_NEAR(*found.order, 1.0, 1e-9);
    EXPECT_NEAR(found.noise->deviation, std::sqrt((400.0 + 3 * 0.01) / 4.0), 1e-12)
        << "of the ladder";
}

TEST(Convergence, NoiseIsPooledByTheNumberOfRepeats) {
    const Convergence found =
        convergence_of(std::array{rung(2, 1.0, 2.0, 3), rung(1, 1.0, 1.0, 2), rung(0.5, 1.0)});
    EXPECT_NEAR(found.noise->deviation, std::sqrt((2 * 4.0 + 1 * 1.0) / 3.0), 1e-12);
}

TEST(Repeats, HaveTheDeviationOfASample) {
    const Repeats found = repeats_of(std::array{1.0, 2.0, 3.0, 4.0});
    EXPECT_DOUBLE_EQ(found.mean, 2.5);
    EXPECT_NEAR(*found.deviation, std::sqrt(5.0 / 3.0), 1e-15);
    EXPECT_FALSE(repeats_of(std::array{7.0}).deviation) << "one run says nothing of its noise";
}

TEST(Repeats, ErrorOfOneRunHasBiasAndScatter) {
    EXPECT_DOUBLE_EQ(error_of_one_run(0.3, {.mean = 13.0, .deviation = 4.0, .count = 5}, -10.0),
                     0.5);
    EXPECT_DOUBLE_EQ(error_of_one_run(0.1, {.mean = -9.0, .deviation = {}, .count = 1}, -10.0),
                     0.1);
}

TEST(Pareto, KeepsWhatNothingBeatsInBoth) {
    const std::array offers{Offer{1, 0.3}, Offer{2, 0.1}, Offer{3, 0.2}, Offer{4, 0.05},
                            Offer{2, 0.1}};
    EXPECT_EQ(pareto_front(offers), (std::vector{true, true, false, true, true}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, CheapestWithinTheAskedErrorOrNone) {
    const std::array offers{Offer{1, 0.3}, Offer{3, 0.05}, Offer{3, 0.04}, Offer{9, 0.01}};
    EXPECT_EQ(cheapest_within(offers, 0.05), 2u);
    EXPECT_EQ(cheapest_within(offers, 0.01), 3u);
    EXPECT_EQ(cheapest_within(offers, 0.001), std::nullopt);
    const std::array unknown{Offer{1, std::nan("")}};
    EXPECT_EQ(cheapest_within(unknown, 1.0), std::nullopt);
}

}  // namespace
}  // namespace breach::statistics::convergence_test
