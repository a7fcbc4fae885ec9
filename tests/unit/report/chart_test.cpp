#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/fault/fault.hpp"
#include "services/report/chart/draw.hpp"
#include "services/report/figures/element_test_figures.hpp"
#include "services/report/figures/stability_figures.hpp"

namespace breach::report {
namespace {

Chart sample() {
    return {"a < b & c",
            {"N [-]", Scale::logarithmic},
            {"CSR [-]"},
            {{"one", {1, 10, 100}, {0.3, 0.2, 0.1}, Style::line_and_points}}};
}

TEST(Ticks, AreRoundAndInside) {
    EXPECT_EQ(linear_ticks({0, 10}), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(log_ticks({1, 100}).size(), 7u);
}

TEST(LogAxis, HasEqualDecades) { EXPECT_NEAR(place(10, {1, 100}, Scale::logarithmic), 0.5, 1e-15); }

TEST(Chart, EscapesTextAndDrawsEachPoint) {
    const std::string svg = as_svg(sample());
    EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
    std::size_t circles = 0;
    for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++circles;
    EXPECT_EQ(circles, 3u);
}

TEST(Chart, DrawsAPointByWhatItsValueIsWorth) {
    Chart chart = sample();
    EXPECT_EQ(as_svg(chart).find("lower bound"), std::string::npos);
    chart.series[0].certainty = {Certainty::certain, Certainty::at_least, Certainty::doubtful};
    const std::string svg = as_svg(chart);
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (std::size_t at = 0; (at = svg.find(text, at)) != std::string::npos; ++at) ++found;
        return found;
    };
    EXPECT_EQ(count("v-9m-3.5 3.5l3.5-3.5l3.5 3.5"), 2u)
        << "an arrow at its point and in the legend";
    EXPECT_EQ(count("r=\"4\" fill=\"#fff\""), 4u) << "hollow, both there and in the legend";
    EXPECT_EQ(count("stroke-dasharray=\"2.4 1.6\""), 2u);
    EXPECT_EQ(count(">lower bound</text>"), 1u);
    EXPECT_EQ(count(">questionable</text>"), 1u);
    EXPECT_EQ(as_csv(chart),
              "series,\"N [-]\",\"CSR [-]\",\"certainty\"\n\"one\",1,0.3,\"certain\"\n"
              "\"one\",10,0.2,\"lower bound\"\n\"one\",100,0.1,\"questionable\"\n");
    chart.series[0].certainty.pop_back();
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
}

TEST(Chart, DrawsKnownErrorsAsABand) {
    Chart chart = sample();
    EXPECT_EQ(as_svg(chart).find("fill-opacity=\"0.16\""), std::string::npos);
    chart.series[0].error = {0.05, 0.02, std::numeric_limits<double>::quiet_NaN()};
    const std::string svg = as_svg(chart);
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (std::size_t at = 0; (at = svg.find(text, at)) != std::string::npos; ++at) ++found;
        return found;
    };
    EXPECT_EQ(count("stroke-opacity=\"0.7\""), 2u) << "a whisker where the error is known";
    EXPECT_EQ(count("fill-opacity=\"0.16\""), 1u) << "a band between neighbours that have one";
    EXPECT_EQ(as_csv(chart),
              "series,\"N [-]\",\"CSR [-]\",\"error\"\n\"one\",1,0.3,0.05\n"
              "\"one\",10,0.2,0.02\n\"one\",100,0.1,\n");
    chart.series[0].error.pop_back();
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
}

TEST(Chart, RefusesWhatHasNoPlace) {
    Chart chart = sample();
    chart.series[0].x[0] = 0.0;
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
    chart.series[0].x[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(as_svg(chart), std::invalid_argument);
}

TEST(FigureData, EqualsTheSeries) {
    EXPECT_EQ(as_csv(sample()),
              "series,\"N [-]\",\"CSR [-]\"\n\"one\",1,0.3\n\"one\",10,0.2\n\"one\",100,0.1\n");
}

TEST(Report, MissingFolderIsAnIoError) {
    EXPECT_THROW(stability_figures("/nonexistent"), fault::IoError);
    EXPECT_THROW(element_test_figures("/nonexistent"), fault::IoError);
}

TEST(Report, DrawsTheSurfaceOfStraightPiecesBesideTheCircle) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("breach_polyline_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scene.completed.json") << R"({"section": {"regions": []}})";
    std::ofstream(folder / "result.json")
        << R"({"circle": {"center": [0, 10], "radius": 10}, "entry": [10, 10], "exit": [0, 0],
               "non_circular": {"factor_of_safety": 1.25, "points": [[0, 0], [6, 2], [10, 10]]}})";
    const auto figures = stability_figures(folder);
    std::filesystem::remove_all(folder);
    ASSERT_EQ(figures.size(), 1u);
    const Series& drawn = figures[0].chart.series.back();
    EXPECT_EQ(drawn.name, "non-circular, FS 1.25");
    EXPECT_EQ(drawn.x, (std::vector<double>{0, 6, 10}));
    EXPECT_EQ(drawn.y, (std::vector<double>{0, 2, 10}));
}

TEST(Report, DrawsTheAnswerAlongAWeakLayerAndTheCircleBesideIt) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("breach_along_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scene.completed.json") << R"({"section": {"regions": []}})";
    std::ofstream(folder / "result.json")
        << R"({"surface": "composite", "factor_of_safety": 0.75, "floor": [[-20, 3], [20, 3]],
               "circle": {"center": [0, 10], "radius": 10}, "entry": [10, 10], "exit": [-7, 3],
               "bishop": {"circle": {"center": [0, 10], "radius": 10}, "entry": [10, 10],
                          "exit": [0, 0], "factor_of_safety": 1.5}})";
    const auto figures = stability_figures(folder);
    std::filesystem::remove_all(folder);
    const auto& series = figures.at(0).chart.series;
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[0].name, "critical");
    EXPECT_GE(*std::ranges::min_element(series[0].y), 3.0 - 1e-12) << "it follows its own floor";
    EXPECT_EQ(series[1].name, "circle, FS 1.5");
    EXPECT_LT(*std::ranges::min_element(series[1].y), 0.1);
}

TEST(Report, DrawsACompositeSurfaceAlongItsFloor) {
    const auto folder =
        std::filesystem::temp_directory_path() / ("breach_floor_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scene.completed.json")
        << R"({"section": {"regions": []}, "lem": {"floor": [[0, 2], [3, 2], [7, 4]]}})";
    std::ofstream(folder / "result.json")
        << R"({"circle": {"center": [0, 10], "radius": 10}, "entry": [10, 10], "exit": [-2, 2]})";
    const auto figures = stability_figures(folder);
    std::filesystem::remove_all(folder);
    const Series& drawn = figures.at(0).chart.series.back();
    EXPECT_NEAR(drawn.x.front(), 10.0, 1e-12);
    EXPECT_NEAR(drawn.y.front(), 10.0, 1e-12);
    EXPECT_NEAR(drawn.x.back(), -2.0, 1e-12);
    EXPECT_NEAR(drawn.y.back(), 2.0, 1e-12) << "it ends on the floor, above its circle";
    EXPECT_TRUE(std::ranges::any_of(drawn.x, [](double x) { return std::abs(x - 3) < 1e-12; }))
        << "the floor's kink";
    for (std::size_t i = 0; i < drawn.x.size(); ++i) {
        const double x = drawn.x[i], arc = 10 - std::sqrt(std::max(0.0, 100 - x * x));
        const double floor = x <= 3 ? 2 : std::min(4.0, 2 + (x - 3) / 2);
        EXPECT_NEAR(drawn.y[i], std::max(arc, floor), 0.01) << "at x = " << x;
    }
}

}  // namespace
}  // namespace breach::report
