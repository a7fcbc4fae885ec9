// Properties of every law in the list.
#include "core/materials/law.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace breach::materials::law_test {
namespace {

/// One of each law, with all optional parts.
template <class... Each>
std::vector<Law> one_of_each(const std::variant<Each...>*) {
    return {Law(Each{})...};
}
std::vector<Law> laws() { return one_of_each(static_cast<const Law*>(nullptr)); }

TEST(Laws, HaveWordsOfTheirOwn) {
    std::set<std::string> types, names;
    for (const Law& law : laws()) {
        types.insert(traits(law).type);
        names.insert(traits(law).name);
    }
    EXPECT_EQ(types.size(), laws().size());
    EXPECT_EQ(names.size(), laws().size());
}

TEST(Laws, AreTheSameForParticlesAsForThePointAlone) {
    for (const Law& law : laws()) {
        const auto lanes = for_particles(law);
        if (!lanes) continue;
        const bool yields = std::visit([](const auto& each) { return each.yields; }, *lanes);
        EXPECT_EQ(yields, traits(law).yields) << traits(law).type;
    }
}

TEST(Laws, WithCohesionAndFrictionShowBothAsEntriesAndAsStrength) {
    for (Law& law : laws()) {
        const StrengthEntries entries = strength_entries(law);
        EXPECT_EQ(entries.c != nullptr, traits(law).c_and_phi) << traits(law).type;
        EXPECT_EQ(entries.phi != nullptr, traits(law).c_and_phi) << traits(law).type;
        if (!traits(law).c_and_phi) continue;
        *entries.c = 7e3;
        *entries.phi = 0.5;
        ASSERT_TRUE(limit_strength(law)) << traits(law).type;
        EXPECT_EQ(limit_strength(law)->c, 7e3);
        EXPECT_EQ(limit_strength(law)->tan_phi, std::tan(0.5));
        EXPECT_TRUE(traits(law).frictional);
    }
}

TEST(Laws, TakeAnotherElasticityAndScaleTheStrainsOfTheirSoftening) {
    const MohrCoulomb soil{{2e7, 0.3}, 1e4, 0.5, 0.0, 0.0, Softening{0.02, 0.1, 1e3, 0.1}};
    const Law half = adapted(Law(soil), {1e7, 0.3}, 3.0);
    EXPECT_EQ(elasticity(half).E, 1e7);
    EXPECT_EQ(softening(half)->epsilon_q_start, 3.0 * 0.02);
    EXPECT_EQ(softening(half)->epsilon_q_end, 3.0 * 0.1);
    EXPECT_EQ(softening(half)->c_residual, 1e3);
    EXPECT_EQ(softening(Law(LinearElastic{})), nullptr);
}

}  // namespace
}  // namespace breach::materials::law_test
