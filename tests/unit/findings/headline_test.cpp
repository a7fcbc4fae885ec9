// The line that every view of a run begins with.
#include "services/findings/headline.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace breach::findings::headline_test {

using nlohmann::json;

std::string text_of(const HeadlineFacts& facts) { return headline_of(facts).text; }

TEST(Headline, SaysHowFarSoilFlowsWithItsError) {
    const HeadlineFacts facts{.soil = Soil{.farthest = 10.42, .stood = false, .error = 1.23},
                              .factor_of_safety = 1.412,
                              .factor_of_safety_liquefied = 0.62};
    EXPECT_EQ(headline_of(facts).outcome, Outcome::flows);
    EXPECT_EQ(text_of(facts),
              "flows 10.4 \u00b1 1.2 m beyond the toe; FS 1.41 as built, 0.62 liquefied");
    EXPECT_EQ(text_of({.factor_of_safety = 1.5, .factor_of_safety_post_seismic = 0.651}),
              "FS 1.5 as built, 0.651 after the shaking");
    EXPECT_EQ(text_of({.soil = Soil{.farthest = 10.42, .stood = false, .lower_bound = true}}),
              "flows \u2265 10.4 m beyond the toe (error not known)");
    EXPECT_EQ(text_of({.soil = Soil{.farthest = 30.0, .stood = false, .worst_of = 32}}),
              "flows 30 m beyond the toe in the worst of 32 samples");
}

TEST(Headline, SaysThatSoilFlowsThoughNonePassesTheToe) {
    EXPECT_EQ(text_of({.soil = Soil{.farthest = -2.2, .stood = false}}),
              "flows, ends 2.2 m short of the toe (error not known)");
}

TEST(Headline, StandsOnlyWhereTheSoilHardlyMoved) {
    const HeadlineFacts facts{.soil = Soil{.farthest = -0.02, .stood = true}};
    EXPECT_EQ(headline_of(facts).outcome, Outcome::stands);
    EXPECT_EQ(text_of(facts), "stands");
    EXPECT_EQ(headline_of({.stood_in_fem = true}).outcome, Outcome::stands);
}

TEST(Headline, JudgesByTheFactorOnlyWhereNoRunoutWasAskedFor) {
    EXPECT_EQ(text_of({.factor_of_safety = 1.5, .lem_alone = true}), "stands; FS 1.5 as built");
    EXPECT_EQ(text_of({.factor_of_safety = 0.9, .lem_alone = true}), "fails; FS 0.9 as built");
    EXPECT_EQ(
        headline_of({.factor_of_safety = 1.5, .factor_of_safety_liquefied = 0.7, .lem_alone = true})
            .outcome,
        Outcome::fails);
    EXPECT_EQ(text_of({.factor_of_safety = 1.5}), "FS 1.5 as built")
        << "the runout is still to come";
    EXPECT_EQ(text_of({}), "");
}

TEST(Headline, TakesTheRunoutFromTheResult) {
    const json result{{"runout_beyond_toe", 10.0}, {"runout_largest", 12.0}, {"stood", false}};
    EXPECT_EQ(soil_of(result)->farthest, 10.0);
    EXPECT_EQ(soil_of({{"runout_beyond_toe", 0.0}, {"runout_largest", -3.0}})->farthest, -3.0);
    EXPECT_FALSE(soil_of(json()));
}

}  // namespace breach::findings::headline_test
