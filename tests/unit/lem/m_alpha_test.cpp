// The limit of m_alpha: slices to which it applies, and surfaces below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lem_tool/facts.hpp"
#include "tests/unit/lem/small_scenes.hpp"

namespace breach::lem {
namespace {

using small::json;

/// A circle with a steep exit in front of the toe: its passive slices have a small m_alpha.
json steep_toe(const json& limit, double phi_base = 40.0) {
    json text = small::two_layers({{"circle", {{"center", {38, 6.2}}, {"radius", 9}}}});
    text["materials"]["fill"] = small::soil(20, 1, 10);
    text["materials"]["base"] = small::soil(18, 1, phi_base);
    text["lem"]["m_alpha"] = limit;
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
    const Critical found = analysed(steep_toe({{"least", 0}}), slices);
    EXPECT_EQ(found.bishop.balance, Balance::found);
    EXPECT_NEAR(found.bishop.m_alpha, smallest_by_hand(slices, found.bishop.factor_of_safety),
                1e-12);
    EXPECT_LT(found.bishop.m_alpha, 0.6);
}

TEST(MAlpha, BelowTheLimitAGivenCircleIsAnsweredOrRefused) {
    Slices slices;
    const double m_alpha = analysed(steep_toe({{"least", 0}}), slices).bishop.m_alpha;
    const auto with = [&](double least, const char* given) {
        return steep_toe({{"least", least}, {"given_circle", given}});
    };
    EXPECT_NO_THROW(analysed(with(m_alpha + 1e-6, "answered"), slices));
    EXPECT_NO_THROW(analysed(with(m_alpha - 1e-6, "refused"), slices));
    try {
        analysed(with(m_alpha + 1e-6, "refused"), slices);
        FAIL() << "was not refused";
    } catch (const fault::BadInput& refused) {
        EXPECT_NE(std::string(refused.what()).find("m_alpha"), std::string::npos) << refused.what();
    }
}

TEST(MAlpha, CountsSlicesWithoutFrictionOnlyWhereAsked) {
    Slices slices;
    const json frictionless = steep_toe({{"least", 0}, {"slices", "frictional"}}, 0.0);
    json all = frictionless;
    all["lem"]["m_alpha"]["slices"] = "all";
    const double some = analysed(frictionless, slices).bishop.m_alpha;
    const double every = analysed(all, slices).bishop.m_alpha;
    double steepest = 1.0;
    for (std::size_t i = 0; i < slices.count; ++i) {
        if (slices.tan_phi[i] == 0.0) steepest = std::min(steepest, slices.cos_a[i]);
    }
    EXPECT_LT(every, some);
    EXPECT_NEAR(every, steepest, 1e-12);
}

TEST(MAlpha, LimitsWhatTheSearchFinds) {
    double before = 0.0;
    for (const double least : {0.0, 0.2, 0.7, 0.85}) {
        json text = small::two_layers(small::some_search());
        text["lem"]["m_alpha"] = {{"least", least}};
        const scene::Scene scene = small::parsed(text);
        const SearchResult found = search(make_model(scene), *scene.lem->search);
        const Bishop& best = found.critical.value().bishop;
        EXPECT_GE(best.m_alpha, least);
        EXPECT_GE(best.factor_of_safety, before * (1.0 - 1e-5)) << "a limit lets fewer surfaces by";
        before = best.factor_of_safety;
    }
}

}  // namespace
}  // namespace breach::lem
