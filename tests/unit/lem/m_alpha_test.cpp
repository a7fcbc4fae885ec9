// m_alpha of a circle, and its limit in a search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lem_tool/facts.hpp"
#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

/// A circle with a steep exit in front of the toe: its passive slices have a small m_alpha.
json steep_toe(double phi_base) {
    json text = small::two_layers({{"circle", {{"center", {38, 6.2}}, {"radius", 9}}}});
    text["materials"]["fill"] = small::soil(20, 1, 10);
    text["materials"]["base"] = small::soil(18, 1, phi_base);
    return text;
}

Critical analysed(const json& text, Slices& slices) {
    const scene::Scene scene = small::parsed(text);
    const Model model = make_model(scene);
    slices = make_slices(model.strata, model.slices);
    const Critical critical = analyse_circle(scene, model, slices);
    cut(model.strata, model.soils, critical.surface, model.slices, slices);
    return critical;
}

double smallest_by_hand(const Slices& s, double F) {
    double least = 1.0;
    for (std::size_t i = 0; i < s.count; ++i)  // slides to the right: bases fall where sin_a < 0
        least = std::min(least, s.cos_a[i] - s.sin_a[i] * s.tan_phi[i] / F);
    return least;
}

TEST(MAlpha, IsTheSmallestOfTheSlices) {
    Slices slices;
    const Critical found = analysed(steep_toe(40.0), slices);
    EXPECT_EQ(found.bishop.balance, Balance::found);
    EXPECT_NEAR(found.bishop.m_alpha, smallest_by_hand(slices, found.bishop.factor_of_safety),
                1e-12);
    EXPECT_LT(found.bishop.m_alpha, 0.6);
}

TEST(MAlpha, LimitsWhatTheSearchFinds) {
    const scene::Scene scene = small::parsed(small::two_layers(small::some_search()));
    const SearchResult found = search(make_model(scene), *scene.lem->search);
    EXPECT_GE(found.critical.value().bishop.m_alpha, least_m_alpha);
}

}  // namespace
}  // namespace breach::lem
