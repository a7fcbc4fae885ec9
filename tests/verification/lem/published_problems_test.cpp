// Published slopes, each against the Bishop value that its source prints; the source is in the
// case's file. The tolerance is the case's own: sources differ among themselves by that much
// (slices, search, drawings).
#include <gtest/gtest.h>

#include <ostream>

#include "lem_tool/facts.hpp"
#include "tests/verification/lem/case_scene.hpp"

namespace breach::lem::published_problems_test {
namespace {

/// The facts of result.json: of the critical surface, or of the given circle.
nlohmann::json answer(const scene::Scene& scene) {
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    if (scene.lem->search) {
        const SearchResult found = found_by_search(scene, model, 1);
        nlohmann::json facts = facts_of(model, *found.critical, slices);
        facts["surfaces"] = found.tally.analysed;
        return facts;
    }
    nlohmann::json facts = facts_of(model, analyse_circle(scene, model, slices), slices);
    facts["surfaces"] = 1;
    return facts;
}

/// Values that the source prints beside Bishop's, on its own critical surface.
void print_others(const cases::json& problem, const nlohmann::json& facts) {
    for (const auto& [name, value] : problem.at("other_published").items()) {
        std::printf("  also published: %s %.4f\n", name.c_str(), value.get<double>());
    }
    for (const char* method : {"ordinary", "spencer"}) {
        if (facts.at(method).is_null()) continue;
        std::printf("  computed %s %.4f\n", method,
                    facts.at(method).at("factor_of_safety").get<double>());
    }
}

class PublishedProblem : public testing::TestWithParam<const char*> {};

TEST_P(PublishedProblem, IsReproduced) {
    const cases::json problem = cases::load(GetParam());
    const double published = problem.at("published_bishop");
    const double allowed = problem.at("tolerance_rel");
    const nlohmann::json facts = answer(cases::scene_of(problem));
    const double F = facts.at("factor_of_safety");
    const double difference = F / published - 1.0;
    std::printf(
        "%s\n  published %.4f  computed %.4f  difference %+.2f %%  allowed %.1f %%  surfaces %d\n",
        problem.at("title").get<std::string>().c_str(), published, F, 100.0 * difference,
        100.0 * allowed, facts.at("surfaces").get<int>());
    print_others(problem, facts);
    EXPECT_LE(std::abs(difference), allowed);
}

INSTANTIATE_TEST_SUITE_P(
    Bishop, PublishedProblem,
    testing::Values("01_acads_1a", "03_acads_1c_circle", "04_acads_1c_search",
                    "06_acads_2b_talbingo", "09_arai_ex1", "11_arai_ex2_weak", "12_fk1_case1",
                    "14_fk_case2_composite", "16a_submerged_75", "16c_buoyant",
                    "18_bishop_morgenstern_gl1", "21_taylor_D2", "24_taylor_45deg_deep",
                    "25_vertical_cut", "26_infinite_slope_dry", "29a_pyslope_a_R3",
                    "29a_pyslope_a_R4", "29b_pyslope_b_R3", "29c_pyslope_c_R3", "29c_pyslope_c_R4",
                    "29c_pyslope_c_R5", "29d_pyslope_d_R5"),
    [](const auto& problem) { return std::string(problem.param); });

struct OtherMethod {
    const char* problem;
    const char* method;
    double published;
    double allowed;  ///< relative
};

/// What ctest shows beside the name.
void PrintTo(const OtherMethod& other, std::ostream* stream) {
    *stream << other.method << " of " << other.problem;
}

class OtherMethodOfProblem : public testing::TestWithParam<OtherMethod> {};

TEST_P(OtherMethodOfProblem, IsReproduced) {
    const OtherMethod& other = GetParam();
    const nlohmann::json facts = answer(cases::scene_of(cases::load(other.problem)));
    const double F = facts.at(other.method).at("factor_of_safety");
    std::printf("%s, %s: published %.4f  computed %.4f  difference %+.2f %%  allowed %.1f %%\n",
                other.problem, other.method, other.published, F, 100.0 * (F / other.published - 1),
                100.0 * other.allowed);
    EXPECT_NEAR(F / other.published, 1.0, other.allowed);
}

// The same surface as the source's where the circle is given (0.5 %, composite 2 % as for Bishop);
// 2 % where our Bishop-critical circle stands for Spencer's own.
INSTANTIATE_TEST_SUITE_P(
    Methods, OtherMethodOfProblem,
    testing::Values(OtherMethod{"12_fk1_case1", "ordinary", 1.928, 0.005},
                    OtherMethod{"12_fk1_case1", "spencer", 2.073, 0.005},
                    OtherMethod{"14_fk_case2_composite", "ordinary", 1.288, 0.02},
                    OtherMethod{"14_fk_case2_composite", "spencer", 1.373, 0.02},
                    OtherMethod{"03_acads_1c_circle", "spencer", 1.375, 0.01},
                    OtherMethod{"11_arai_ex2_weak", "spencer", 0.425, 0.02}),
    [](const auto& other) { return std::string(other.param.problem) + "_" + other.param.method; });

void expect_published(const char* what, const cases::json& text, double bishop, double spencer) {
    const nlohmann::json facts = answer(scene::parse_scene(text.dump(), what));
    const double F = facts.at("factor_of_safety");
    const double S = facts.at("spencer").at("factor_of_safety");
    std::printf(
        "%s: Bishop published %.3f computed %.4f (%+.2f %%), Spencer published %.3f computed "
        "%.4f (%+.2f %%), allowed 1 %%\n",
        what, bishop, F, 100 * (F / bishop - 1), spencer, S, 100 * (S / spencer - 1));
    EXPECT_NEAR(F / bishop, 1.0, 0.01);
    EXPECT_NEAR(S / spencer, 1.0, 0.01);
}

// Giam & Donald (1989) EX1(b) and EX1(d), the values of Slide verification 2 and 4, from memory of
// that manual. 1 % as for the same slopes' other problems.
TEST(AcadsWithCrackFullOfWater, IsReproduced) {
    cases::json text = cases::scene_json(cases::load("01_acads_1a"));
    text["materials"]["soil"]["law"]["c_kPa"] = 32.0;
    text["materials"]["soil"]["law"]["phi_deg"] = 10.0;
    // 2 c / (gamma sqrt K_a) = 3.81 m; the line only says how heavy water is
    text["lem"]["tension_crack"] = {{"depth", 3.81}, {"filled", 1.0}};
    text["lem"]["water"] = {{"line", cases::json::array({cases::json::array({0, -100})})},
                            {"density", 981.0}};
    expect_published("ACADS EX1(b)", text, 1.596, 1.592);
}

TEST(AcadsWithShaking, IsReproduced) {
    cases::json text = cases::scene_json(cases::load("04_acads_1c_search"));
    text["lem"]["seismic_coefficient"] = 0.15;
    expect_published("ACADS EX1(d)", text, 1.015, 0.991);
}

}  // namespace
}  // namespace breach::lem::published_problems_test
