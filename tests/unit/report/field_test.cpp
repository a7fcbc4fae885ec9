#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "services/report/chart/colour_map.hpp"
#include "services/report/chart/draw.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {
namespace {

Chart two_quads() {
    Chart chart{"strain", {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
    chart.field = Field{"epsilon_q [%]",          4,           {0, 1, 1, 0, 1, 2, 2, 1},
                        {0, 0, 1, 1, 0, 0, 1, 1}, {0.5, 7.25}, {0, 8}};
    return chart;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
    return n;
}

TEST(ColourMap, DarkensEvenly) {
    const double step = lightness_of(colour_at(0.0)) - lightness_of(colour_at(0.1));
    double largest = 0.0;
    for (int k = 1; k < 10; ++k) {
        const double here =
            lightness_of(colour_at(0.1 * k)) - lightness_of(colour_at(0.1 * (k + 1)));
        largest = std::max(largest, std::abs(here - step) / step);
    }
    std::printf("uneven by %.3f of a step, allowed 0.05 (eight bits, edge of sRGB)\n", largest);
    EXPECT_LT(largest, 0.05);
    EXPECT_GT(step, 0.06);
}

TEST(ColourMap, ClampsWhatLiesBeyond) {
    EXPECT_EQ(colour_at(-1.0), colour_at(0.0));
    EXPECT_EQ(colour_at(7.0), colour_at(1.0));
}

TEST(Field, HasOnePathPerColourAndABar) {
    const std::string svg = as_svg(two_quads());
    EXPECT_EQ(count(svg, "z\"/>"), 2u) << "two values, two colours";
    EXPECT_NE(svg.find("epsilon_q [%]"), std::string::npos);
}

TEST(Field, IsKeptWholeInItsData) {
    EXPECT_EQ(as_csv(two_quads()),
              "x1 [m],y1 [m],x2 [m],y2 [m],x3 [m],y3 [m],x4 [m],y4 [m],\"epsilon_q [%]\"\n"
              "0,0,1,0,1,1,0,1,0.5\n1,0,2,0,2,1,1,1,7.25\n");
}

TEST(Field, WithMissingCornersIsRefused) {
    Chart chart = two_quads();
    chart.field->x.pop_back();
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
    EXPECT_THROW(as_csv(chart), std::invalid_argument);
}

TEST(Columns, OfUnequalLengthAreRefused) {
    const Chart chart{"one", {"x [m]"}, {"y [m]"}, {{"short", {1, 2, 3}, {1, 2}}}};
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
    EXPECT_THROW(as_csv(chart), std::invalid_argument);
}

TEST(Segments, EachHaveTwoEnds) {
    Chart chart{
        "mesh", {"x [m]"}, {"y [m]"}, {{"edges", {0, 1, 1, 1}, {0, 0, 0, 1}, Style::segments}}};
    EXPECT_EQ(count(as_svg(chart), "scale(.1)"), 1u);
    chart.series[0].x.pop_back();
    chart.series[0].y.pop_back();
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
}

TEST(FlatCharts, SayThatHeightsAreExaggerated) {
    const Chart flat{"valley", {"x [m]"},    {"y [m]"}, {{"ground", {0, 1000}, {0, 20}}},
                     {},       Aspect::equal};
    EXPECT_NE(as_svg(flat).find("y [m], heights x "), std::string::npos);
    const Chart steep{"dam", {"x [m]"},    {"y [m]"}, {{"ground", {0, 100}, {0, 60}}},
                      {},    Aspect::equal};
    EXPECT_EQ(as_svg(steep).find("heights x"), std::string::npos);
}

}  // namespace
}  // namespace breach::report
