#include "transfer_tool/laws.hpp"

#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer {
namespace {

using mechanics::Voigt;

exchange::ParticleState points_with(const std::vector<Voigt>& stress, double epsilon_q_plastic) {
    exchange::ParticleState s;
    s.regions = {"strip 0"};
    s.stress = stress;
    s.position.resize(stress.size());
    s.volume.assign(stress.size(), 2.0);
    s.mass.assign(stress.size(), 3.0);
    s.volume_0.assign(stress.size(), 0.0);
    s.epsilon_q_plastic.assign(stress.size(), epsilon_q_plastic);
    s.region.assign(stress.size(), 0);
    return s;
}

materials::MohrCoulomb softening_soil() {
    materials::MohrCoulomb law = meshes::frictional;
    law.softening = materials::Softening{.epsilon_q_start = 0.0,
                                         .epsilon_q_end = 0.1,
                                         .c_residual = 0.0,
                                         .tan_phi_residual = 0.5 * std::tan(law.phi)};
    return law;
}

TEST(YieldReturn, InsideStaysBitForBitAndOutsideEndsOnTheSurface) {
    const std::vector<materials::Law> laws{meshes::frictional};
    const Voigt inside(-50e3, -100e3, -60e3, 5e3);
    const Voigt outside(-20e3, -200e3, -90e3, 60e3);
    const Voigt tension(30e3, 10e3, 5e3, 0.0);
    auto s = points_with({inside, outside, tension}, 0.0);
    s.position[1] = Vec2(4.0, 5.0);
    const YieldShare report = return_to_yield_surface(laws, s).front();
    EXPECT_EQ(report.returned, 2u);
    EXPECT_EQ(report.mass, 6.0);
    EXPECT_NEAR(report.largest_excess, materials::yield_excess(meshes::frictional, {outside, 0.0}),
                1e-6);
    EXPECT_EQ(report.place, Vec2(4.0, 5.0)) << "where it is largest";
    EXPECT_EQ(s.stress[0], inside);
    for (int p : {1, 2})  // on the surface to round-off of 100 kPa
        EXPECT_LT(materials::yield_excess(meshes::frictional, {s.stress[p], 0.0}), 1e-6);
}

TEST(YieldReturn, UsesTheStrengthThatSofteningHasLeft) {
    const std::vector<materials::Law> laws{softening_soil()};
    const Voigt sigma(-60e3, -110e3, -60e3, 0.0);  // inside at peak, outside at residual strength
    auto softened = points_with({sigma}, 0.1), sound = points_with({sigma}, 0.0);
    EXPECT_EQ(return_to_yield_surface(laws, softened).front().returned, 1u);
    EXPECT_EQ(return_to_yield_surface(laws, sound).front().returned, 0u);
    EXPECT_EQ(softened.epsilon_q_plastic[0], 0.1) << "the return is not soil's plastic strain";
}

TEST(SofteningStart, TotalStrainDrivesWhereTheLawSaysSo) {
    materials::MohrCoulomb by_total = softening_soil();
    by_total.softening->driver = materials::SofteningDriver::total;
    const std::vector<materials::Law> laws{softening_soil(), by_total, meshes::elastic};
    auto s = points_with({Voigt::Zero(), Voigt::Zero(), Voigt::Zero()}, 0.02);
    s.mass.assign(3, 5.0);
    s.region = {0, 1, 2};
    s.epsilon_q = {0.03, 0.04, 0.05};
    start_softening(laws, s);
    EXPECT_EQ(s.epsilon_q_plastic, (std::vector<double>{0.02, 0.04, 0.02}));
    const auto report = softening_of(laws, s);
    ASSERT_EQ(report.size(), 2u) << "the elastic soil does not soften";
    EXPECT_EQ(report[1].driver, materials::SofteningDriver::total);
    EXPECT_EQ(report[1].mean, 0.04);
}

TEST(ReferenceVolume, IsTheVolumeAtZeroMeanStress) {
    const std::vector<materials::Law> laws{meshes::elastic};
    const double K = meshes::elastic.elasticity.bulk_modulus();
    auto s = points_with({Voigt(-3e5, -3e5, -3e5, 1e5), Voigt::Zero()}, 0.0);
    find_reference_volumes(laws, s);
    EXPECT_DOUBLE_EQ(s.volume_0[0] * (1.0 - 3e5 / K), 2.0);
    EXPECT_DOUBLE_EQ(s.volume_0[1], 2.0);
}

TEST(ReferenceVolume, RefusesACompressionBeyondTheLaw) {
    const std::vector<materials::Law> laws{meshes::elastic};
    const double K = meshes::elastic.elasticity.bulk_modulus();
    auto s = points_with({Voigt(-2 * K, -2 * K, -2 * K, 0.0)}, 0.0);
    EXPECT_THROW(find_reference_volumes(laws, s), fault::Breakdown);
}

TEST(SoilMap, RefusesASceneThatTheSnapshotWasNotMadeWith) {
    const auto mesh = meshes::grid({.regions = 2});
    auto scene = meshes::scene_for(mesh, meshes::elastic, meshes::settings());
    scene.section.regions[0].name = "other";
    scene.materials[0].name = "clay";
    try {
        SoilMap(mesh, scene, "snapshot.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_EQ(refusal.faults().size(), 2u) << "the lost region and the other's material";
    }
}

}  // namespace
}  // namespace breach::transfer
