// The factor of safety does not depend on position, side and units.
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;
using Map = std::function<json(double, double)>;

json moved(json text, const Map& map, double length, double stress) {
    for (json& region : text["section"]["regions"]) {
        for (json& vertex : region["polygon"]) vertex = map(vertex[0], vertex[1]);
    }
    for (auto& [name, material] : text["materials"].items()) {
        material["law"]["c_kPa"] = material["law"]["c_kPa"].get<double>() * stress;
    }
    text["gravity"] = text["gravity"].get<double>() * stress / length;
    json& lem = text["lem"];
    if (lem.contains("circle")) {
        json& circle = lem["circle"];
        circle["center"] = map(circle["center"][0], circle["center"][1]);
        circle["radius"] = circle["radius"].get<double>() * length;
    }
    if (lem.contains("search")) {
        for (const char* range : {"entry", "exit"}) {
            json& ends = lem["search"][range];
            double a = map(ends[0], 0.0)[0];
            double b = map(ends[1], 0.0)[0];
            ends = {std::min(a, b), std::max(a, b)};
        }
        lem["search"]["minimum_depth"] = 0.5 * length;
    }
    return text;
}

struct Motion {
    const char* name;
    Map map;
    double length;
    double stress;
};

const std::vector<Motion>& motions() {
    static const std::vector<Motion> all{{"shifted",
                                          [](double x, double y) {
                                              return json{x + 1234.5, y - 87.0};
                                          },
                                          1.0, 1.0},
                                         {"mirrored",
                                          [](double x, double y) {
                                              return json{-x, y};
                                          },
                                          1.0, 1.0},
                                         {"scaled",
                                          [](double x, double y) {
                                              return json{0.25 * x, 0.25 * y};
                                          },
                                          0.25, 3.0}};
    return all;
}

TEST(FactorOfSafety, OfACircleIsUnchangedByShiftMirrorAndScale) {
    const json text = small::two_layers(small::some_circle());
    const double F = small::circle_bishop(small::parsed(text)).factor_of_safety;
    ASSERT_GT(F, 0.5);
    for (const Motion& motion : motions()) {
        const auto other = small::parsed(moved(text, motion.map, motion.length, motion.stress));
        EXPECT_NEAR(small::circle_bishop(other).factor_of_safety, F, 1e-9 * F) << motion.name;
    }
}

TEST(FactorOfSafety, OfASearchIsUnchangedByShiftMirrorAndScale) {
    const json text = small::two_layers(small::some_search());
    const auto scene = small::parsed(text);
    const double F =
        search(make_model(scene), *scene.lem->search).critical.value().bishop.factor_of_safety;
    for (const Motion& motion : motions()) {
        const auto other = small::parsed(moved(text, motion.map, motion.length, motion.stress));
        const double same =
            search(make_model(other), *other.lem->search).critical.value().bishop.factor_of_safety;
        // The descent stops when a restart gains less than 1e-5.
        EXPECT_NEAR(same, F, 1e-5 * F) << motion.name;
    }
}

TEST(Search, GivesTheSameAnswerOnOneAndOnManyThreads) {
    const auto scene = small::parsed(small::two_layers(small::some_search()));
    const Model model = make_model(scene);
    const auto one = search(model, *scene.lem->search, 1);
    for (const int threads : {2, 5}) {
        const auto many = search(model, *scene.lem->search, threads);
        EXPECT_EQ(many.critical->bishop.factor_of_safety, one.critical->bishop.factor_of_safety);
        EXPECT_EQ(many.critical->surface.circle.radius, one.critical->surface.circle.radius);
        EXPECT_EQ(many.tally.analysed, one.tally.analysed);
        ASSERT_EQ(many.pairs.size(), one.pairs.size());
        for (std::size_t i = 0; i < one.pairs.size(); ++i) {
            EXPECT_EQ(many.pairs[i].critical.bishop.factor_of_safety,
                      one.pairs[i].critical.bishop.factor_of_safety);
        }
    }
}

TEST(Search, IsDeterministicAndNoWorseThanAFinerGrid) {
    json text = small::two_layers(small::some_search());
    const auto scene = small::parsed(text);
    const auto once = search(make_model(scene), *scene.lem->search);
    const auto again = search(make_model(scene), *scene.lem->search);
    EXPECT_EQ(once.critical->bishop.factor_of_safety, again.critical->bishop.factor_of_safety);
    EXPECT_EQ(once.tally.analysed, again.tally.analysed);
    for (const char* count : {"entry_points", "exit_points", "depths"}) {
        text["lem"]["search"][count] = 40;
    }
    const auto finer = small::parsed(text);
    const auto fine = search(make_model(finer), *finer.lem->search);
    std::printf("coarse %.7f with %lld surfaces, fine %.7f with %lld\n",
                once.critical->bishop.factor_of_safety, static_cast<long long>(once.tally.analysed),
                fine.critical->bishop.factor_of_safety,
                static_cast<long long>(fine.tally.analysed));
    // 50 slices have an error of 1e-4 that is discontinuous in the cuts: the limit of any search.
    EXPECT_NEAR(once.critical->bishop.factor_of_safety / fine.critical->bishop.factor_of_safety,
                1.0, 5e-4);
}

}  // namespace
}  // namespace breach::lem
