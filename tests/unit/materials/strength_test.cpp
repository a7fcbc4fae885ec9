// Strength profiles, and published relations for liquefied soil at values given by others.
#include <gtest/gtest.h>

#include <cmath>

#include "core/materials/law.hpp"
#include "core/materials/strength/profile.hpp"
#include "core/mechanics/atmosphere.hpp"

namespace breach::materials::strength_test {
namespace {

using enum Relation;

constexpr double kPa = 1e3;
constexpr double p_a = mechanics::standard_atmosphere;

// Sordo et al. (2024) took the residual strengths of Mochikoshi's tailings from Weber (2015); their
// eight values are those of (N1)60cs = 6, printed to one decimal: within 0.14 kPa.
TEST(ResidualStrength, OfWeberIsThatOfMochikoshisTailings) {
    const double published[][2] = {{25, 3.0},  {50, 4.3},  {75, 5.6},   {100, 6.5},
                                   {125, 7.4}, {175, 9.1}, {225, 10.6}, {250, 11.1}};
    for (const auto& [sigma_v0, s_r] : published)
        EXPECT_NEAR(residual_strength(weber_2015, 6.0, sigma_v0 * kPa), s_r * kPa, 0.145 * kPa);
}

// By hand at one atmosphere: psf = exp(0.1407 N + 4.2399) - 0.43991 (N^1.45 + 0.2 N + 41.13).
TEST(ResidualStrength, OfWeberAtOneAtmosphere) {
    EXPECT_NEAR(residual_strength(weber_2015, 0.0, p_a) / 47.880258980336,
                std::exp(4.2399) - 0.43991 * 41.13, 1e-9);
    EXPECT_NEAR(residual_strength(weber_2015, 10.0, p_a) / 47.880258980336, 252.040, 0.001);
    EXPECT_EQ(residual_strength(weber_2015, 2.0, 0.0), 0.0) << "the formula is negative there";
}

// The line of the paper's mean, and its end at the end of the data.
TEST(ResidualStrength, OfOlsonAndStarkIsALineInTheSounding) {
    EXPECT_NEAR(residual_strength(olson_stark_2002_spt, 0.0, 100 * kPa), 3 * kPa, 1e-9);
    EXPECT_NEAR(residual_strength(olson_stark_2002_spt, 12.0, 100 * kPa), 12 * kPa, 1e-9);
    EXPECT_NEAR(residual_strength(olson_stark_2002_cpt, 4.0, 100 * kPa), 8.72 * kPa, 1e-9);
    EXPECT_EQ(residual_strength(olson_stark_2002_cpt, 20.0, 100 * kPa),
              residual_strength(olson_stark_2002_cpt, 6.5, 100 * kPa));
    EXPECT_EQ(residual_strength(olson_stark_2002_spt, 40.0, 100 * kPa),
              residual_strength(olson_stark_2002_spt, 12.0, 100 * kPa));
}

// The monograph has one pair of curves over two axes: soundings with the same strength after
// redistribution have the same without. Negligible redistribution doubles the ratio at (N1)60cs-Sr
// = 15.84 and q_c1Ncs-Sr = 109.0.
TEST(ResidualStrength, OfIdrissAndBoulangerIsOneCurveForBothSoundings) {
    const auto ratio = [](Relation relation, double sounding) {
        return residual_strength(relation, sounding, 100 * kPa) / (100 * kPa);
    };
    EXPECT_NEAR(ratio(idriss_boulanger_2008_spt_redistribution, 15.84), 0.134, 0.001);
    EXPECT_NEAR(ratio(idriss_boulanger_2008_cpt_redistribution, 109.0), 0.134, 0.001);
    EXPECT_NEAR(ratio(idriss_boulanger_2008_spt, 15.84), 2.0 * 0.134, 0.002);
    EXPECT_NEAR(ratio(idriss_boulanger_2008_cpt, 109.0), 2.0 * 0.134, 0.003);
    EXPECT_NEAR(ratio(idriss_boulanger_2008_spt, 0.0), 0.0324, 1e-4);
    for (double N = 4.0; N <= 15.5; N += 0.5) {
        const double redistributed = ratio(idriss_boulanger_2008_spt_redistribution, N);
        double low = 0.0, high = 110.0;
        while (high - low > 1e-9) {
            const double q = 0.5 * (low + high);
            const bool below = ratio(idriss_boulanger_2008_cpt_redistribution, q) < redistributed;
            (below ? low : high) = q;
        }
        const double undisturbed = ratio(idriss_boulanger_2008_spt, N);
        EXPECT_NEAR(ratio(idriss_boulanger_2008_cpt, low), undisturbed, 0.02 * undisturbed) << N;
        EXPECT_LT(redistributed, undisturbed);
    }
}

TEST(ResidualStrength, OfKramerAndWangLiesAboveWebers) {
    EXPECT_NEAR(residual_strength(kramer_wang_2015, 6.0, p_a) / p_a, 0.089726, 1e-6);
    EXPECT_NEAR(residual_strength(kramer_wang_2015, 10.0, 2.0 * p_a) / p_a, 0.204144, 1e-6);
    const auto above = [](double N) {
        return residual_strength(kramer_wang_2015, N, p_a) / residual_strength(weber_2015, N, p_a);
    };
    EXPECT_NEAR(above(4.0), 1.53, 0.01);
    EXPECT_NEAR(above(6.0), 1.39, 0.01);
    EXPECT_NEAR(above(8.0), 1.27, 0.01);
    EXPECT_NEAR(above(10.0), 1.17, 0.01);
}

TEST(ResidualStrength, OfEveryRelationGrowsWithSoundingAndStress) {
    for (const Relation relation :
         {weber_2015, kramer_wang_2015, olson_stark_2002_spt, olson_stark_2002_cpt,
          idriss_boulanger_2008_spt, idriss_boulanger_2008_spt_redistribution,
          idriss_boulanger_2008_cpt, idriss_boulanger_2008_cpt_redistribution}) {
        const auto [low, high] = facts_of(relation).range;
        double before = 0.0;
        for (int k = 0; k <= 20; ++k) {
            const double here = residual_strength(relation, low + (high - low) * k / 20, 100 * kPa);
            EXPECT_GT(here, before) << facts_of(relation).name;
            EXPECT_LT(here, 60 * kPa) << facts_of(relation).name << ": above tan(phi')";
            before = here;
        }
        EXPECT_LT(residual_strength(relation, high, 50 * kPa),
                  residual_strength(relation, high, 400 * kPa));
    }
}

TEST(StrengthProfile, KindsAreWhatTheySay) {
    const Place place{.depth = 4.0, .elevation = 11.0, .sigma_v0 = 40 * kPa};
    const auto c = [&](const StrengthCurve& curve) { return strength_at(curve, place).c; };
    EXPECT_EQ(c({Undrained{.constant = 25 * kPa}}), 25 * kPa);
    EXPECT_EQ(c({Undrained{.constant = 5 * kPa, .per_metre = 2 * kPa}}), 13 * kPa);
    EXPECT_NEAR(c({Undrained{.coefficient = 0.25 * p_a}}), 10 * kPa, 1e-9);
    EXPECT_EQ(c({Undrained{.coefficient = 0.25 * p_a}, 12 * kPa}), 12 * kPa) << "the minimum";
    EXPECT_EQ(c({Table{Along::elevation, {{10, 3e3}, {12, 5e3}}}}), 4e3);
    EXPECT_EQ(c({Table{Along::depth, {{5, 3e3}, {12, 5e3}}}}), 3e3) << "held beyond its ends";
    EXPECT_EQ(c({Table{Along::sigma_v0, {{1e4, 3e3}, {2e4, 5e3}}}}), 5e3);
    const Strength drained = strength_at({Effective{2 * kPa, 0.5}}, place);
    EXPECT_EQ(drained.c, 2 * kPa);
    EXPECT_EQ(drained.tan_phi, std::tan(0.5));
    EXPECT_EQ(c({BySounding{weber_2015, {Along::elevation, {{0, 4.0}, {22, 8.0}}}}}),
              residual_strength(weber_2015, 6.0, 40 * kPa));
}

TEST(StrengthProfile, PointsSoftenFromPeakToResidualUnlessLiquefied) {
    const Place place{};
    StrengthProfile profile{
        {Effective{4 * kPa, 0.6}}, StrengthCurve{Undrained{.constant = 1e3}}, {}};
    const PointStrength firm = strength_of_point(profile, place, Liquefaction::before);
    EXPECT_EQ(firm.c_residual, 4 * kPa) << "no strains: it does not soften";
    profile.softening = SofteningStrains{0.01, 0.1, SofteningDriver::plastic};
    const PointStrength soft = strength_of_point(profile, place, Liquefaction::before);
    EXPECT_EQ(soft.c, 4 * kPa);
    EXPECT_EQ(soft.c_residual, 1 * kPa);
    EXPECT_EQ(soft.tan_phi_residual, 0.0);
    const PointStrength liquid = strength_of_point(profile, place, Liquefaction::liquefied);
    EXPECT_EQ(liquid.c, 1 * kPa);
    EXPECT_EQ(liquid.tan_phi, 0.0);
    EXPECT_EQ(liquid.c_residual, 1 * kPa);
}

}  // namespace
}  // namespace breach::materials::strength_test
