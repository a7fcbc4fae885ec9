// The table of an accuracy study.
#include "services/cli/accuracy_view.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace breach::cli {
namespace {

using nlohmann::json;

json row(int step, const json& error) {
    return {{"ladder", "cells"},
            {"step", step},
            {"setting", {"/mpm/cell_size=2"}},
            {"value", 31.25},
            {"standard_deviation", 0.5},
            {"draws", 3},
            {"error", error},
            {"error_of_a_run", error},
            {"mean_within_asked", step == 1 ? json{{"draws", 4}, {"cpu_seconds", 6.5}} : json()},
            {"below_noise", step == 2},
            {"on_pareto_front", step == 1},
            {"questionable", false},
            {"cpu_seconds", 1.5},
            {"wall_seconds", 1.6},
            {"peak_memory_MB", nullptr},
            {"reason", error.is_null() ? "it is the reference" : ""}};
}

TEST(AccuracyTable, MarksFrontNoiseAndRecommendation) {
    const json answer{{"quantity", "runout"},
                      {"unit", "m"},
                      {"time", nullptr},
                      {"asked_error", 0.05},
                      {"reference", "the finest rung of each ladder"},
                      {"rows", {row(1, 0.034), row(2, 0.01), row(3, nullptr)}},
                      {"ladders", {{{"name", "cells"}, {"message", "order 1.4"}}}},
                      {"recommended", {{"ladder", "cells"}, {"step", 1}}},
                      {"recommendation", "The cheapest setting within 5 % is that."}};
    const std::string text = as_accuracy_table(answer);
    EXPECT_NE(text.find("runout [m]"), std::string::npos);
    EXPECT_NE(
        text.find("3.4 %     3.4 %      1.5       1.6            -                4            "
                  "6.5  => *\n"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("~  the error is within the noise"), std::string::npos);
    EXPECT_NE(text.find("it is the reference"), std::string::npos);
    EXPECT_EQ(text.find("?  questionable"), std::string::npos) << "no row is";
    EXPECT_NE(text.find("cells: order 1.4\n"), std::string::npos);
    EXPECT_TRUE(text.ends_with("\nThe cheapest setting within 5 % is that.\n"));
}

}  // namespace
}  // namespace breach::cli
