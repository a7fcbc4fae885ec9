// The text view of an uncertainty study.
#include "services/cli/uncertainty_view.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace breach::cli {
namespace {

using nlohmann::json;

json importance(const char* name, const json& rank) {
    return {{"parameter", name},
            {"measure", rank.is_null() ? "correlation_ratio" : "rank_correlation"},
            {"rank_correlation", rank},
            {"low", rank.is_null() ? json() : json(-0.9)},
            {"high", rank.is_null() ? json() : json(-0.7)},
            {"partial_rank_correlation", nullptr},
            {"partial_low", nullptr},
            {"partial_high", nullptr},
            {"first_order", 0.25},
            {"first_order_low", 0.125},
            {"first_order_high", 0.5}};
}

json answer(const json& tornado) {
    return {{"samples",
             {{"left_out", {{{"sample", "s0005"}, {"state", "failed"}, {"reason", "it broke"}}}}}},
            {"quantities",
             {{"runout_beyond_toe",
               {{"unit", "m"},
                {"count", 60},
                {"of", 64},
                {"mean", 12.5},
                {"sd", 3.0},
                {"percentiles", {{{"p", 50}, {"value", 12.25}, {"low", 11.5}, {"high", 13.5}}}},
                {"importance", {importance("viscosity", -0.8), importance("motion", json())}},
                {"tornado", tornado}}}}},
            {"inverse", nullptr},
            {"sentences", {"60 of 64 samples ended with a result."}}};
}

TEST(UncertaintyView, SaysOnHowManyOfHowManyItRestsAndWhatIsLeftOut) {
    const std::string shown = as_uncertainty_view(
        answer({{"q2", 0.8},
                {"form", "linear"},
                {"at_median", 12.0},
                {"bars", {{{"parameter", "viscosity"}, {"p10", 15.0}, {"p90", 9.0}}}}}));
    EXPECT_NE(shown.find("runout_beyond_toe [m], 60 of 64 samples"), std::string::npos) << shown;
    EXPECT_NE(shown.find("11.5 to 13.5"), std::string::npos) << shown;
    EXPECT_NE(shown.find("-0.8 (-0.9 to -0.7)"), std::string::npos) << shown;
    EXPECT_NE(shown.find("15 / 9"), std::string::npos) << shown;
    EXPECT_NE(shown.find("s0005 failed: it broke"), std::string::npos) << shown;
    EXPECT_NE(shown.find("60 of 64 samples ended with a result."), std::string::npos) << shown;
}

TEST(UncertaintyView, MarksWhatIsALowerBound) {
    json moving = answer({{"refused", "-"}, {"q2", 0.0}});
    moving["quantities"]["runout_beyond_toe"]["bound_from"] = 12.0;
    const std::string shown = as_uncertainty_view(moving);
    EXPECT_NE(shown.find(">= 12.25"), std::string::npos) << shown;
    EXPECT_NE(shown.find(" 11.5 to >= 13.5"), std::string::npos) << shown;
    EXPECT_NE(shown.find(">= 12.5"), std::string::npos) << "the mean: " << shown;
}

TEST(UncertaintyView, OfARefusedTornadoThereIsNoBar) {
    const std::string shown =
        as_uncertainty_view(answer({{"refused", "Q2 is 0.40; 0.70 is needed"}, {"q2", 0.4}}));
    EXPECT_EQ(shown.find("at p10 / p90: by"), std::string::npos) << shown;
    EXPECT_NE(shown.find("motion"), std::string::npos) << shown;
}

TEST(UncertaintyView, OfAnInverseStudyTheStepsAreShown) {
    json found = answer({{"refused", "-"}, {"q2", 0.0}});
    found["quantities"] = json::object();
    found["inverse"] = {
        {"vary", "residual strength"},
        {"quantity", "runout_beyond_toe"},
        {"steps", {{{"value", 0.5}, {"results", {200, 230}}, {"result", 215}, {"state", "done"}}}}};
    const std::string shown = as_uncertainty_view(found);
    EXPECT_NE(shown.find("residual strength  runout_beyond_toe  lattices  state"),
              std::string::npos)
        << shown;
    EXPECT_NE(shown.find("0.5                215         2  done"), std::string::npos) << shown;
}

}  // namespace
}  // namespace breach::cli
