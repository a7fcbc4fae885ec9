#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

scene::Scene softening_soil() {
    scene::Scene scene =
        one_soil(sand(1e7, 0.3, 20e3, 30.0), 1800.0, rectangle(0, 0, 4, 4), 0.5, 8.0, 6.0);
    std::get<materials::MohrCoulomb>(scene.materials[0].law).softening = materials::Softening{
        .epsilon_q_start = 0.02, .epsilon_q_end = 0.1, .c_residual = 2e3, .tan_phi_residual = 0.1};
    return scene;
}

materials::Softening softening_of(const scene::Scene& scene) {
    const Body body = filled_body(scene);
    return *materials::softening(body.zones.at(0).law);
}

TEST(Zones, SofteningStrainsAreTakenAsTheyStandWithoutALength) {
    EXPECT_EQ(softening_of(softening_soil()).epsilon_q_start, 0.02);
    EXPECT_EQ(softening_of(softening_soil()).epsilon_q_end, 0.1);
}

TEST(Zones, SofteningStrainsGrowAsTheCellsShrink) {
    scene::Scene scene = softening_soil();
    scene.mpm->softening_length = 1.25;  // cells of 0.5 m: 2.5 times the strain
    EXPECT_DOUBLE_EQ(softening_of(scene).epsilon_q_start, 0.05);
    EXPECT_DOUBLE_EQ(softening_of(scene).epsilon_q_end, 0.25);
    EXPECT_EQ(softening_of(scene).c_residual, 2e3);
    // The displacement across a band one cell wide is constant: epsilon h.
    scene.mpm->cell_size = 0.25;
    EXPECT_DOUBLE_EQ(softening_of(scene).epsilon_q_end * 0.25, 0.25 * 0.5);
}

TEST(Zones, SofteningStrainsOfANonlocalSoilAreThoseOfItsBandOnAnyCells) {
    scene::Scene scene = softening_soil();
    scene.mpm->softening_length = 1.25;
    scene.materials[0].nonlocal_length = 2.0;  // bands of 5 m: a quarter of the strain
    for (const double h : {0.5, 0.25}) {
        scene.mpm->cell_size = h;
        EXPECT_DOUBLE_EQ(softening_of(scene).epsilon_q_start, 0.005);
        EXPECT_DOUBLE_EQ(softening_of(scene).epsilon_q_end, 0.025);
    }
    scene.mpm->softening_length.reset();
    EXPECT_EQ(softening_of(scene).epsilon_q_end, 0.1);
}

/// A file has the scene's strains; with scaled softening, a point is softened by the same share.
TEST(Zones, SoftenedSoilStaysAsSoftenedAtAnyScale) {
    scene::Scene scene = softening_soil();
    scene.mpm->softening_length = 1.25;
    exchange::ParticleState state = fill_section(scene).state;
    std::ranges::fill(state.epsilon_q_plastic, 0.06);  // half-way from 0.02 to 0.1
    const Body body = make_body(scene, zoned_points(scene, state, "test"), "test");
    const materials::Softening law = *materials::softening(body.zones.at(0).law);
    const double share = (body.points.epsilon_q_plastic[0] - law.epsilon_q_start) /
                         (law.epsilon_q_end - law.epsilon_q_start);
    EXPECT_NEAR(share, 0.5, 1e-12);
    EXPECT_NEAR(particle_state(scene, body.points).epsilon_q_plastic[0], 0.06, 1e-15);
}

TEST(Zones, WhatIsWrittenCanBeginAgainWithAScaledStiffness) {
    scene::Scene scene = softening_soil();
    scene.gravity = 9.81;
    scene.mpm->fill_stress = scene::FillStress::overburden;
    scene.mpm->stiffness_scale = 0.05;
    const Body body = filled_body(scene);
    const exchange::ParticleState written = particle_state(scene, body.points);
    const Body again = make_body(scene, zoned_points(scene, written, "test"), "test");
    for (std::size_t p = 0; p < body.points.size(); ++p)
        ASSERT_NEAR(again.points.V_0[p] / body.points.V_0[p], 1.0, 1e-12);
}

TEST(Zones, PointsOfAnotherThicknessAreRefused) {
    scene::Scene scene = softening_soil();
    const exchange::ParticleState state = fill_section(scene).state;
    scene.thickness = 2.0;
    EXPECT_THROW(zoned_points(scene, state, "test"), fault::BadInput);
}

TEST(Zones, ViscosityIsTheMaterialsAndShortensTheStep) {
    scene::Scene scene = softening_soil();
    const double dt = courant_step(filled_body(scene), 0.4);
    scene.materials[0].viscosity = 3e4;
    const Body body = filled_body(scene);
    EXPECT_EQ(body.zones.at(0).viscosity, 3e4);
    // 1 / dt grows by 16 eta / (3 rho h^2) / cfl.
    EXPECT_NEAR(1.0 / courant_step(body, 0.4) - 1.0 / dt, 16.0 * 3e4 / (3.0 * 1800.0 * 0.25) / 0.4,
                1e-6);
}

TEST(Zones, OutputsCarryWhatTheTransferKnewOfTheWater) {
    const scene::Scene scene = softening_soil();
    exchange::ParticleState state = fill_section(scene).state;
    for (std::size_t p = 0; p < state.size(); ++p) {
        state.r_u.push_back(1.0 / static_cast<double>(p + 1));
    }
    state.stress_of_regions = {exchange::StressMeasure::total};
    Body body = make_body(scene, zoned_points(scene, state, "test"), "test");
    std::swap(body.points.number[0], body.points.number[1]);  // as sorting does, with the rest
    const exchange::ParticleState out = particle_state(scene, body.points);
    EXPECT_EQ(out.r_u, state.r_u);
    EXPECT_EQ(out.stress_of_regions, state.stress_of_regions);
    const Body dry = filled_body(scene);
    EXPECT_TRUE(particle_state(scene, dry.points).r_u.empty());
    EXPECT_TRUE(particle_state(scene, dry.points).stress_of_regions.empty());
}

/// Every number of every field of the points.
template <class AnyState>
auto numbers_of(AnyState& state) {
    std::vector<decltype(state.mass.data())> numbers;
    for_each_field(state, [&](auto, auto, auto, auto& values) {
        auto* first = reinterpret_cast<decltype(state.mass.data())>(values.data());
        for (std::size_t k = 0; k < values.size() * sizeof values[0] / sizeof *first; ++k)
            numbers.push_back(first + k);
    });
    return numbers;
}

TEST(Zones, EveryFieldOfAFileGoesInAndComesOutAgain) {
    const scene::Scene scene = softening_soil();
    exchange::ParticleState state = fill_section(scene).state;
    for_each_field(state, [&](std::string_view name, auto, auto, auto& values) {
        if (name != "pore_pressure") values.resize(state.size());
    });
    double next = 1.0;
    for (double* number : numbers_of(state)) *number = next++;
    // Larger than drawn it would begin with a gap.
    for (std::size_t p = 0; p < state.size(); ++p) state.volume_0[p] = state.mass[p] / 1800.0;
    const exchange::ParticleState out =
        particle_state(scene, zoned_points(scene, state, "test").points);
    const auto before = numbers_of(state);
    const auto after = numbers_of(out);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t k = 0; k < after.size(); ++k) ASSERT_EQ(*after[k], *before[k]) << k;
}

TEST(Zones, WhatAFemHasStretchedBeginsWithAGap) {
    const scene::Scene scene = softening_soil();
    exchange::ParticleState state = fill_section(scene).state;
    const double drawn = state.volume_0[0];
    state.volume_0[0] = 4.0 * drawn;
    state.volume_0[1] = 1.05 * drawn;
    const Points points = zoned_points(scene, state, "test").points;
    EXPECT_NEAR(points.V_0[0], 1.1 * drawn, 1e-12);
    EXPECT_NEAR(points.gap[0], std::log(4.0 / 1.1), 1e-12);
    EXPECT_EQ(points.V_0[1], 1.05 * drawn);
    EXPECT_EQ(points.gap[1], 0.0);
}

}  // namespace
}  // namespace breach::mpm::test
