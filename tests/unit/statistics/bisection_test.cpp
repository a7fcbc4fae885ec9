#include "core/statistics/bisection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

namespace breach::statistics::bisection_test {
namespace {

struct Search {
    Plateau plateau;
    int runs = 0;
};

Search search(const std::vector<double>& times, const std::function<double(double)>& runout,
              double share, int seeds = 4) {
    std::vector<std::optional<double>> known(times.size());
    Search done;
    while (true) {
        const Advice advice = advise(times, known, share, seeds);
        if (advice.run_next.empty()) {
            if (advice.plateau) done.plateau = *advice.plateau;
            return done;
        }
        for (const std::size_t i : advice.run_next) {
            EXPECT_FALSE(known[i]) << "asked twice for " << times[i];
            known[i] = runout(times[i]);
            ++done.runs;
        }
    }
}

std::vector<double> grid(std::size_t count) {
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i) times[i] = 0.1 * static_cast<double>(i);
    return times;
}

/// As in the paper: nothing, a rise, a plateau of 215 m from 15.25 to 20 s, a decline.
double paper(double t) {
    if (t < 12.5) return 0.0;
    if (t < 15.25) return 215 * (t - 12.5) / 2.75;
    return t <= 20 ? 215.0 : 215 - 22 * (t - 20);
}

TEST(Bisection, FindsBothEdgesOfThePapersPlateauWithFewRuns) {
    const auto times = grid(226);  // to 22.5 s
    const Search found = search(times, paper, 0.9);
    std::vector<double> on;  // by the full sweep
    for (const double t : times) {
        if (paper(t) >= 0.9 * 215) on.push_back(t);
    }
    EXPECT_DOUBLE_EQ(found.plateau.lower.on, on.front());
    EXPECT_DOUBLE_EQ(found.plateau.upper.on, on.back());
    EXPECT_NEAR(*found.plateau.lower.off, on.front() - 0.1, 1e-9);
    EXPECT_NEAR(*found.plateau.upper.off, on.back() + 0.1, 1e-9);
    std::cout << "226 snapshots: " << found.runs << " MPM runs\n";
    EXPECT_LE(found.runs, 4 + 2 * 7);  // seeds, and log2(75) halvings for each edge
}

TEST(Bisection, AnEdgeBeyondTheRangeIsOpen) {
    const auto times = grid(29);
    const Search found = search(
        times, [](double t) { return t < 1.75 ? -2.2 : 5.0; }, 0.75);
    EXPECT_NEAR(found.plateau.lower.on, 1.8, 1e-9);
    EXPECT_NEAR(*found.plateau.lower.off, 1.7, 1e-9);
    EXPECT_NEAR(found.plateau.upper.on, 2.8, 1e-9);
    EXPECT_FALSE(found.plateau.upper.off);
}

TEST(Bisection, ALargerRunoutOnTheWayRaisesTheLevel) {
    const auto times = grid(65);
    // A peak beside a shoulder: the seeds find the shoulder first.
    const auto runout = [](double t) { return t < 2.5 ? 0.0 : t < 3.6 ? 10.0 : 6.0; };
    const Search found = search(times, runout, 0.75);
    EXPECT_NEAR(found.plateau.largest, 10, 0);
    EXPECT_NEAR(found.plateau.lower.on, 2.5, 1e-9);
    EXPECT_NEAR(found.plateau.upper.on, 3.5, 1e-9);
}

TEST(Bisection, NoRunoutMeansNoPlateauAfterTheSeeds) {
    const std::vector<double> times = grid(50);
    std::vector<std::optional<double>> known(50);
    EXPECT_EQ(advise(times, known, 0.9, 5).run_next, (std::vector<std::size_t>{0, 12, 25, 37, 49}));
    const Search found = search(
        times, [](double) { return -2.0; }, 0.9, 5);
    EXPECT_EQ(found.runs, 5);
    for (auto& each : known) each = -2.0;
    EXPECT_FALSE(advise(times, known, 0.9, 5).plateau);
}

TEST(Bisection, FailedTransfersAreOffThePlateau) {
    const Search found = search(
        grid(21), [](double t) { return t > 1.55 ? no_runout : 3.0; }, 0.9);
    EXPECT_NEAR(found.plateau.upper.on, 1.5, 1e-9);
    EXPECT_NEAR(*found.plateau.upper.off, 1.6, 1e-9);
}

TEST(Bisection, OneTwoOrNoSnapshotsAreHandled) {
    EXPECT_TRUE(advise({}, {}, 0.9, 4).run_next.empty());
    EXPECT_EQ(search(
                  grid(1), [](double) { return 1.0; }, 0.9)
                  .runs,
              1);
    EXPECT_EQ(search(
                  grid(2), [](double) { return 1.0; }, 0.9)
                  .runs,
              2);
}

}  // namespace
}  // namespace breach::statistics::bisection_test
