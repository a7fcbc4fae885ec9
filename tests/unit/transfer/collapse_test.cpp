#include <gtest/gtest.h>

#include "core/materials/norsand/law.hpp"
#include "tests/verification/transfer/meshes.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

namespace {

/// Two elements of 2 x 2 m, one below water and one of dry soil above, under sigma'_v0 = 100 kPa.
exchange::MeshSnapshot two_elements(const scene::Scene& scene, double psi) {
    auto mesh = meshes::grid({.nx = 1, .ny = 2, .width = 2.0, .height = 4.0});
    mesh.regions = {"tailings"};
    mesh.materials_of_regions = {"tailings"};
    meshes::soak(mesh, 2.0, [](const Vec2&) { return 0.0; });
    const auto& law =
        std::get<materials::NorSand>(scene.materials[scene.section.regions[1].material].law);
    mesh.stress.assign(mesh.stress.size(), mechanics::Voigt(-70e3, -100e3, -70e3, 0.0));
    mesh.psi.assign(mesh.stress.size(), psi);
    const auto& ready = law.ready;
    const double e = psi + materials::norsand::critical_void_ratio(ready, 80e3);
    const auto read = materials::norsand::read(
        ready, materials::norsand::initialise(ready, mesh.stress[0], e).state);
    mesh.instability_ratio.assign(mesh.stress.size(), read.q / read.p / read.eta_L);
    return mesh;
}

class CollapsedSoil : public testing::Test {
  protected:
    scene::Scene scene = scene::read_scene(BREACH_ROOT "/workflows/scenes/static_lift.json");
    const std::vector<std::size_t> regions{1};
};

TEST_F(CollapsedSoil, WetSoilHasTheStrengthsOfItsStateAndDrySoilNone) {
    ASSERT_TRUE(liquefied::collapses(scene, 1));
    EXPECT_FALSE(liquefied::collapses(scene, 2)) << "the dike is no NorSand";
    const auto mesh = two_elements(scene, 0.05);
    const Collapse collapse(mesh, scene, regions);
    const auto wet = collapse.at(0, {0.3, 0.3});
    ASSERT_TRUE(wet.has_value());
    EXPECT_FALSE(wet->collapsed);
    // docs/reference/methods/norsand.md, section 15: 0.039360 of sigma'_v0 at psi_0 = 0.05, K_0 =
    // 0.7.
    EXPECT_NEAR(wet->strength.residual / 100e3, 0.039360, 5e-6);
    EXPECT_GT(wet->strength.peak, 0.2 * 100e3);
    EXPECT_FALSE(collapse.at(1, {0.0, 0.5}).has_value());
}

TEST_F(CollapsedSoil, IsPastTheLineAndStrained) {
    auto mesh = two_elements(scene, 0.05);
    const auto collapsed = [&] { return Collapse(mesh, scene, regions).at(0, {0, 0})->collapsed; };
    mesh.epsilon_q.assign(mesh.stress.size(), 2.0 * scene.fem->failure_strain);
    EXPECT_FALSE(collapsed()) << "strained, and below its line";
    mesh.instability_ratio.assign(mesh.stress.size(), 1.0);
    EXPECT_TRUE(collapsed());
    mesh.epsilon_q.assign(mesh.stress.size(), 0.5 * scene.fem->failure_strain);
    EXPECT_FALSE(collapsed()) << "past its line, and not strained";
}

TEST_F(CollapsedSoil, NoSuctionIsCountedOn) {
    const auto mesh = two_elements(scene, -0.05);
    const auto wet = Collapse(mesh, scene, regions).at(0, {0, 0});
    // p = 80 kPa and at most 2 m of water: tau / p = 0.599 of that.
    EXPECT_LT(wet->strength.peak, 0.6 * (80e3 + 20e3));
    EXPECT_GT(wet->strength.peak, 0.59 * 80e3);
}

TEST_F(CollapsedSoil, APeakByItsStateSoftensByTheStrainFromThereOn) {
    auto mesh = two_elements(scene, 0.05);
    const auto begun = [&] {
        Points points = meshes::points_on(mesh, 2);
        points.state.epsilon_q_plastic.assign(points.state.size(), 0.05);
        start_at_state(SoilMap(mesh, scene, "snapshot"), points);
        return std::pair(points.state.epsilon_q_plastic.front(),
                         points.state.epsilon_q_plastic.back());
    };
    EXPECT_EQ(begun(), std::pair(0.0, 0.05)) << "dry soil has the strength of its material";
    mesh.epsilon_q.assign(mesh.stress.size(), 2.0 * scene.fem->failure_strain);
    mesh.instability_ratio.assign(mesh.stress.size(), 1.0);
    EXPECT_EQ(begun(), std::pair(0.05, 0.05)) << "collapsed soil has nothing left to soften";
}

}  // namespace
}  // namespace breach::transfer
