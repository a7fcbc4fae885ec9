// Without friction F is proportional to c: the probability of failure in closed form.
#include "lem_tool/variation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem::variation_test {
namespace {

using small::json;

json clay_slope() {
    json text = small::two_layers(small::some_circle());
    text["materials"]["fill"] = small::soil(20, 25, 0);
    text["materials"]["base"] = small::soil(20, 25, 0);
    return text;
}

double Phi(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

TEST(ProbabilityOfFailure, IsThatOfTheCohesionWithoutFriction) {
    for (const char* distribution : {"normal", "lognormal"}) {
        json text = small::scene(
            {{"clay", small::soil(20, 25, 0)}},
            json::array({small::region("clay", "clay",
                                       {{0, -5}, {60, -5}, {60, 0}, {40, 0}, {20, 10}, {0, 10}})}),
            small::some_circle());
        text["lem"]["probability"] = {{"samples", 2000},
                                      {"seed", 3},
                                      {"variables",
                                       {{{"parameter", "cohesion"},
                                         {"of", "clay"},
                                         {"distribution", distribution},
                                         {"coefficient_of_variation", 0.3}}}}};
        json result;
        const Samples samples = add_probability(small::parsed(text), 2, result);
        const json& facts = result.at("probability");
        const double F = facts.at("factor_of_safety");
        const double s = std::sqrt(std::log(1.09));
        const double expected = std::string(distribution) == "normal"
                                    ? Phi((1.0 / F - 1.0) / 0.3)
                                    : Phi((std::log(1.0 / F) + 0.5 * s * s) / s);
        const double computed = facts.at("probability_of_failure");
        std::printf("%s: F %.4f, P_f %.4f, closed form %.4f, allowed 1/2000\n", distribution, F,
                    computed, expected);
        // one stratified variable: the empirical distribution is exact to one interval
        EXPECT_NEAR(computed, expected, 1.0 / 2000.0);
        EXPECT_NEAR(facts.at("mean").get<double>() / F, 1.0, 1e-3);
        EXPECT_NEAR(facts.at("standard_deviation").get<double>() / F, 0.3, 3e-3);
        json again;
        EXPECT_EQ(add_probability(small::parsed(text), 1, again).factor_of_safety,
                  samples.factor_of_safety);
        EXPECT_EQ(again, result) << "as many threads as you like";
    }
}

/// Undrained fill on undrained clay; `layers` divide the fill.
json undrained_slope(const json& layers, const std::string& varied) {
    json text = clay_slope();
    text["lem"] = small::some_search();
    text["lem"]["undrained"] = {{{"region", "fill"}, {"strength_kPa", 45}},
                                {{"region", "base"}, {"strength_kPa", 40}}};
    text["lem"]["liquefaction"] = layers;
    text["lem"]["probability"] = {{"samples", 200},
                                  {"variables",
                                   {{{"parameter", "undrained_strength"},
                                     {"of", varied},
                                     {"coefficient_of_variation", 0.3}}}}};
    return text;
}

TEST(ProbabilityOfFailure, OfAnUndrainedStrengthIsThatOfItsWholeRegionHoweverLayersDivideIt) {
    const json layers = {{{"region", "fill"}, {"levels", {5, 10}}, {"residual_strength_kPa", 4}},
                         {{"region", "fill"}, {"levels", {0, 5}}, {"residual_strength_kPa", 4}}};
    for (const std::string varied : {"fill", "base"}) {
        json whole, cut;
        const Samples of_whole =
            add_probability(small::parsed(undrained_slope(json::array(), varied)), 1, whole);
        const Samples of_cut =
            add_probability(small::parsed(undrained_slope(layers, varied)), 1, cut);
        EXPECT_EQ(of_cut.names, of_whole.names);
        EXPECT_GT(whole.at("probability").at("standard_deviation").get<double>(), 0.01);
        for (std::size_t i = 0; i < of_whole.factor_of_safety.size(); ++i)
            ASSERT_NEAR(of_cut.factor_of_safety[i], of_whole.factor_of_safety[i], 0.01) << varied;
    }
}

TEST(ProbabilityOfFailure, RefusesWhatTheSceneDoesNotHave) {
    json text = clay_slope();
    text["lem"]["probability"] = {
        {"variables",
         {{{"parameter", "cohesion"}, {"of", "granite"}, {"coefficient_of_variation", 0.1}},
          {{"parameter", "residual_strength"},
           {"of", "fill"},
           {"coefficient_of_variation", 0.1}}}}};
    try {
        (void)small::parsed(text);
        FAIL() << "accepted";
    } catch (const fault::BadInput& bad) {
        const std::string what = bad.what();
        EXPECT_NE(what.find("/lem/probability/variables/0/of"), std::string::npos) << what;
        EXPECT_NE(what.find("/lem/probability/variables/1/of"), std::string::npos) << what;
    }
}

}  // namespace
}  // namespace breach::lem::variation_test
