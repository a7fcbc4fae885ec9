// The page of accuracy studies, from stored answers of the service.
#include "services/report/accuracy_page.hpp"

#include <gtest/gtest.h>

namespace breach::report {
namespace {

using nlohmann::json;

json row(int step, const json& error, double cpu, bool on_front) {
    return {{"ladder", "cells"},
            {"step", step},
            {"setting", {"/mpm/cell_size=" + std::to_string(4 / step)}},
            {"variants", {"cells_" + std::to_string(step)}},
            {"size", 4 / step},
            {"value", 10.0},
            {"standard_deviation", nullptr},
            {"draws", 1},
            {"error", error},
            {"error_of_a_run", error},
            {"mean_within_asked", {{"draws", 4}, {"error", 0.049}, {"cpu_seconds", 4 * cpu}}},
            {"is_reference", error.is_null()},
            {"below_noise", false},
            {"on_pareto_front", on_front},
            {"questionable", false},
            {"cpu_seconds", cpu},
            {"wall_seconds", cpu},
            {"peak_memory_MB", nullptr},
            {"cpu_seconds_by_phase", json::object()},
            {"reason", error.is_null() ? "it is the reference" : ""}};
}

AccuracyAnswer answer(const json& rows) {
    return {"column",
            {{"quantity", "runout"},
             {"unit", "m"},
             {"time", nullptr},
             {"transfer_time", 0.4},
             {"draws", 1},
             {"base", json::array()},
             {"reference", "the finest rung of each ladder"},
             {"asked_error", 0.05},
             {"rows", rows},
             {"ladders", {{{"name", "cells"}, {"message", "order 2"}}}},
             {"recommended", nullptr},
             {"recommendation", "No setting meets 5 %."}}};
}

TEST(AccuracyPage, DrawsErrorAgainstCpuSecondsOnTwoLogarithms) {
    const Figure figure = error_against_time(
        answer({row(1, 0.2, 1.0, true), row(2, 0.1, 8.0, true), row(4, nullptr, 64.0, false)}));
    EXPECT_EQ(figure.chart.x.scale, Scale::logarithmic);
    EXPECT_EQ(figure.chart.y.scale, Scale::logarithmic);
    ASSERT_EQ(figure.chart.series.size(), 2u) << "the ladder and the front";
    EXPECT_EQ(figure.chart.series[0].x, (std::vector{1.0, 8.0})) << "the reference has no error";
    EXPECT_EQ(figure.chart.series[0].y, (std::vector{20.0, 10.0}));
    EXPECT_EQ(figure.chart.marks.at(0).value, 5.0);
}

TEST(AccuracyPage, HasTheTableAndWhatFollowsFromIt) {
    const std::string page =
        accuracy_page({answer(json::array({row(1, 0.2, 1.0, true)}))}, "accuracy");
    EXPECT_NE(
        page.find(
            "| cells | `/mpm/cell_size=4` | 10 | - | 1 | 20 % | 20 % | 1 | 1 | - | 4 | 4 | `*` |"),
        std::string::npos)
        << page;
    EXPECT_NE(page.find("**No setting meets 5 %.**"), std::string::npos);
    EXPECT_NE(page.find("(accuracy/column.svg)"), std::string::npos);
}

TEST(AccuracyPage, WithoutAnyErrorHasNoFigure) {
    const std::string page =
        accuracy_page({answer(json::array({row(4, nullptr, 64.0, false)}))}, "accuracy");
    EXPECT_EQ(page.find(".svg"), std::string::npos);
    EXPECT_NE(page.find("it is the reference"), std::string::npos);
}

}  // namespace
}  // namespace breach::report
