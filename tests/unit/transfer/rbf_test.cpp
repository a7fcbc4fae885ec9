#include "transfer_tool/rbf.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace breach::transfer {
namespace {

double linear(const Vec2& x) { return 5.0 - 3.0 * x.x() + 0.5 * x.y(); }

std::vector<Vec2> scattered(int n, double width, double height) {
    std::vector<Vec2> places;
    for (int i = 0; i < n; ++i)  // quasi-random: multiples of two irrational numbers
        places.emplace_back(width * std::fmod(0.754877666 * i, 1.0),
                            height * std::fmod(0.569840291 * i, 1.0));
    return places;
}

Centres centres(const std::vector<Vec2>& places, double (*field)(const Vec2&)) {
    Values values(static_cast<Eigen::Index>(places.size()), 1);
    for (std::size_t i = 0; i < places.size(); ++i)
        values(static_cast<Eigen::Index>(i), 0) = field(places[i]);
    return merge_coincident(places, values);
}

template <typename Interpolant>
double at(const Interpolant& interpolant, const Vec2& place) {
    Eigen::RowVectorXd value(1);
    interpolant.at(place, value);
    return value[0];
}

TEST(LocalInterpolant, IsExactForLinearFieldsInsideAndOutside) {
    const LocalInterpolant f(centres(scattered(40, 10.0, 10.0), linear));
    for (const Vec2& x : {Vec2(5, 5), Vec2(0, 0), Vec2(12, -3)})
        EXPECT_NEAR(at(f, x), linear(x), 1e-11);  // values of order 10, system of condition 1e3
}

TEST(LocalInterpolant, IsExactForLinearFieldsAtAspectOneToAHundred) {
    const LocalInterpolant f(centres(scattered(40, 10.0, 0.1), linear));
    for (const Vec2& x : {Vec2(5, 0.05), Vec2(0, 0), Vec2(11, 0.12)})
        EXPECT_NEAR(at(f, x), linear(x), 1e-9);
}

TEST(LocalInterpolant, PassesThroughItsCentres) {
    const auto wavy = [](const Vec2& x) { return std::sin(x.x()) * std::cos(2.0 * x.y()); };
    const Centres c = centres(scattered(40, 3.0, 3.0), wavy);
    const LocalInterpolant f(c);
    for (std::size_t i = 0; i < c.position.size(); ++i)
        EXPECT_NEAR(at(f, c.position[i]), wavy(c.position[i]), 1e-11);
}

TEST(LocalInterpolant, CentresOnALineKeepTheSlopeAlongIt) {
    std::vector<Vec2> line;
    for (int i = 0; i < 12; ++i) line.emplace_back(0.6 * i, 0.8 * i);
    const LocalInterpolant f(centres(line, linear));
    const Vec2 on_it(0.6 * 4.5, 0.8 * 4.5);
    const Vec2 beside(on_it + Vec2(-0.08, 0.06));  // 0.1 across
    EXPECT_NEAR(at(f, on_it), linear(on_it), 1e-11);
    // Constant across the line: the value beside it equals that at its foot.
    EXPECT_NEAR(at(f, beside), linear(on_it), 1e-9);
}

TEST(LocalInterpolant, CentresOnABentRowKeepTheSlopeAlongItAlone) {
    // One Gauss point per element, a row 1 m thick that sags by 2 mm; the field changes across it.
    std::vector<Vec2> row;
    for (int i = 0; i < 12; ++i) row.emplace_back(i, 2e-3 * std::sin(0.5 * i));
    const auto noisy = [](const Vec2& x) { return 100.0 + x.x() + 3.0 * std::cos(5.0 * x.x()); };
    const std::vector<Vec2> wanted{{5.2, 0.4}, {5.7, -0.4}};
    const Centres c = centres(row, noisy);
    const LocalInterpolant f(c, wanted), unaware(c);
    for (const Vec2& x : wanted) EXPECT_NEAR(at(f, x), 100.0 + x.x(), 6.0);
    EXPECT_GT(std::abs(at(unaware, wanted[0]) - 100.0), 30.0);
}

TEST(LocalInterpolant, TwoCentresAndOneCentre) {
    const LocalInterpolant two(centres({{0, 0}, {2, 0}}, linear));
    EXPECT_NEAR(at(two, {1, 0}), linear({1, 0}), 1e-12);
    const LocalInterpolant one(centres({{3, 4}}, linear));
    EXPECT_NEAR(at(one, {100, -50}), linear({3, 4}), 1e-12);
}

TEST(MergeCoincident, TakesTheMeanAndCounts) {
    Values values(4, 1);
    values << 1.0, 2.0, 6.0, 9.0;
    const Centres c = merge_coincident({{0, 0}, {5, 5}, {5, 5 + 1e-12}, {9, 0}}, values);
    EXPECT_EQ(c.merged, 1u);
    ASSERT_EQ(c.position.size(), 3u);
    EXPECT_DOUBLE_EQ(c.value(1, 0), 4.0);
}

TEST(MergeCoincident, AllInOnePlaceBecomeOneCentre) {
    Values values(3, 1);
    values << 1.0, 2.0, 6.0;
    const Centres c = merge_coincident({{2, 2}, {2, 2}, {2, 2}}, values);
    ASSERT_EQ(c.position.size(), 1u);
    EXPECT_DOUBLE_EQ(at(LocalInterpolant(c), {7, 7}), 3.0);
}

TEST(GlobalInterpolant, IsExactForAConstantAndPassesThroughItsCentres) {
    const auto constant = [](const Vec2&) { return -7e4; };
    const GlobalInterpolant flat =
        *GlobalInterpolant::through(centres(scattered(100, 20.0, 5.0), constant));
    EXPECT_DOUBLE_EQ(at(flat, {30, 9}), -7e4);
    const auto wavy = [](const Vec2& x) { return std::sin(x.x()) * x.y(); };
    const Centres c = centres(scattered(100, 6.0, 5.0), wavy);
    const GlobalInterpolant f = *GlobalInterpolant::through(c);
    for (std::size_t i = 0; i < c.position.size(); ++i)
        EXPECT_NEAR(at(f, c.position[i]), wavy(c.position[i]), 1e-10);
}

// scipy.interpolate.Rbf's rule, which the paper's reference code uses.
TEST(AverageDistance, IsTheRootOfBoundingAreaPerCentre) {
    const std::vector<Vec2> box{{0, 0}, {8, 0}, {8, 2}, {0, 2}};
    EXPECT_DOUBLE_EQ(average_distance(box), 2.0);
    const std::vector<Vec2> line{{1, 3}, {2, 3}, {5, 3}, {9, 3}};
    EXPECT_DOUBLE_EQ(average_distance(line), 2.0);
}

}  // namespace
}  // namespace breach::transfer
