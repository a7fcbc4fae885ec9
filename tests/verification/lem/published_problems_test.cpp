// Published slopes, each against the Bishop value that its source prints; the source is in the
// case's file. The tolerance is the case's own: sources differ among themselves by that much
// (slices, search, drawings).
#include <gtest/gtest.h>

#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"
#include "tests/verification/lem/case_scene.hpp"

namespace breach::lem {
namespace {

struct Answer {
    double factor_of_safety;
    long long surfaces;
};

Answer answer(const scene::Scene& scene) {
    const Model model = make_model(scene);
    if (scene.lem->search) {
        const SearchResult found = search(model, *scene.lem->search);
        return {found.critical.value().bishop.factor_of_safety, found.tally.analysed};
    }
    Slices slices = make_slices(model.strata, model.slices);
    double least = 1e300;
    for (const Surface& surface : masses_of(model.strata, *scene.lem->circle)) {
        if (cut(model.strata, model.soils, surface, model.slices, slices) != Cut::done) continue;
        const Bishop result = bishop(slices, slide_of(slices), model.k_h);
        if (result.balance == Balance::found) least = std::min(least, result.factor_of_safety);
    }
    return {least, 1};
}

class PublishedProblem : public testing::TestWithParam<const char*> {};

TEST_P(PublishedProblem, IsReproduced) {
    const cases::json problem = cases::load(GetParam());
    const double published = problem.at("published_bishop");
    const double allowed = problem.at("tolerance_rel");
    const Answer mine = answer(cases::scene_of(problem));
    const double difference = mine.factor_of_safety / published - 1.0;
    std::printf(
        "%s\n  published %.4f  computed %.4f  difference %+.2f %%  allowed %.1f %%  surfaces "
        "%lld\n",
        problem.at("title").get<std::string>().c_str(), published, mine.factor_of_safety,
        100.0 * difference, 100.0 * allowed, mine.surfaces);
    EXPECT_LE(std::abs(difference), allowed);
}

INSTANTIATE_TEST_SUITE_P(
    Bishop, PublishedProblem,
    testing::Values("01_acads_1a", "03_acads_1c_circle", "04_acads_1c_search",
                    "06_acads_2b_talbingo", "09_arai_ex1", "11_arai_ex2_weak", "12_fk1_case1",
                    "16a_submerged_75", "16c_buoyant", "18_bishop_morgenstern_gl1", "21_taylor_D2",
                    "24_taylor_45deg_deep", "25_vertical_cut", "26_infinite_slope_dry",
                    "29a_pyslope_a_R3", "29a_pyslope_a_R4", "29b_pyslope_b_R3", "29d_pyslope_d_R5"),
    [](const auto& problem) { return std::string(problem.param); });

}  // namespace
}  // namespace breach::lem
