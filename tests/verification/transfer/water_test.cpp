// Pore pressure, total and effective stress, liquefied layers, saturated and unsaturated soil.
#include <gtest/gtest.h>

#include "mpm_solver/body/points.hpp"
#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::water_test {
namespace {

using exchange::StressMeasure;
using mechanics::Vec2;

materials::MohrCoulomb undrained(double s_r) {
    materials::MohrCoulomb law = meshes::frictional;
    law.c = s_r;
    law.phi = 0.0;
    return law;
}

/// A pond ("strip 0") beside a dike ("strip 1"), water to the top, 12 m by 10 m.
struct Ground {
    meshes::MeshSnapshot mesh;
    scene::Scene scene;
};
Ground ground(const std::function<double(const Vec2&)>& r_u) {
    Ground g{meshes::grid({.nx = 12, .ny = 10, .regions = 2}), {}};
    meshes::soak(g.mesh, 10.0, r_u);
    const auto places = meshes::gauss_places(g.mesh);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double sigma_v = -9000.0 * (10.0 - places[i].y());
        g.mesh.stress[i] = {0.5 * sigma_v, sigma_v, 0.5 * sigma_v, 0.0};
    }
    g.scene = meshes::scene_for(g.mesh, meshes::frictional, meshes::settings(2));
    g.scene.materials.push_back({"liquefied_1", 1800.0, undrained(3e3)});
    g.scene.materials.push_back({"liquefied_2", 1800.0, undrained(5.6e3)});
    g.scene.materials.push_back({"wet", 1800.0, meshes::frictional});
    return g;
}

TEST(PorePressure, ALinearFieldIsCarriedExactlyOnADeformedMesh) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    meshes::set_in_motion(g.mesh);
    for (std::size_t i = 0; i < g.mesh.position_0.size(); ++i) {
        const Vec2 x = g.mesh.position_0[i] + g.mesh.displacement[i];
        g.mesh.pore_pressure[i] = 5e4 - 9810.0 * x.y() + 300.0 * x.x();
    }
    const auto t = meshes::transferred(g.mesh, g.scene);
    for (std::size_t p = 0; p < t.state.size(); ++p) {
        const Vec2& x = t.state.position[p];
        EXPECT_NEAR(t.state.pore_pressure[p], 5e4 - 9810.0 * x.y() + 300.0 * x.x(), 1e-9);
    }
}

TEST(PorePressure, LosesWhatAlternatesFromCornerToCorner) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    const auto even = meshes::transferred(g.mesh, g.scene);
    for (std::size_t i = 0; i < g.mesh.position_0.size(); ++i) {
        const Vec2& x = g.mesh.position_0[i];
        g.mesh.pore_pressure[i] += std::lround(x.x() + x.y()) % 2 == 0 ? 30e3 : -30e3;
    }
    const auto alternating = meshes::transferred(g.mesh, g.scene);
    for (std::size_t p = 0; p < even.state.size(); ++p) {
        EXPECT_NEAR(alternating.state.pore_pressure[p], even.state.pore_pressure[p], 1e-9);
        EXPECT_NEAR(alternating.state.r_u[p], even.state.r_u[p], 1e-12);
    }
}

// sigma_total = sigma' - u I; all else is unchanged.
TEST(Stress, TotalIsEffectiveLessThePorePressure) {
    Ground g = ground([](const Vec2&) { return 0.3; });
    const auto total = meshes::transferred(g.mesh, g.scene);
    g.scene.transfer->stress = scene::TransferredStress::effective;
    const auto effective = meshes::transferred(g.mesh, g.scene);
    EXPECT_EQ(total.state.stress_of_regions.front(), StressMeasure::total);
    EXPECT_EQ(effective.state.stress_of_regions.front(), StressMeasure::effective);
    for (std::size_t p = 0; p < total.state.size(); ++p) {
        const double u = total.state.pore_pressure[p];
        EXPECT_EQ(u, effective.state.pore_pressure[p]);
        const mechanics::Voigt back =
            total.state.stress[p] + u * mechanics::Voigt(1.0, 1.0, 1.0, 0.0);
        EXPECT_LT((back - effective.state.stress[p]).norm(), 1e-9);
        EXPECT_NEAR(total.state.r_u[p], 0.3, 1e-12);
    }
}

// sigma_b = sigma' + (p - u) I: the effective stress where p is the steady pore pressure, less the
// excess where there is some. Water level with the ground, whose pressure the mesh says.
TEST(Stress, InStandingWaterIsEffectiveLessTheExcessPressure) {
    for (const double r_u : {0.0, 0.3}) {
        Ground g = ground([&](const Vec2&) { return r_u; });
        const auto dry = meshes::transferred(g.mesh, g.scene);
        g.scene.mpm = meshes::cells(1.0, 12.0, 20.0);
        g.scene.mpm->water = {{{0.0, 3.0}}, 1000.0};  // wrong within the mesh
        const auto wet = meshes::transferred(g.mesh, g.scene);
        EXPECT_EQ(wet.state.stress_of_regions.front(), StressMeasure::buoyant);
        EXPECT_EQ(wet.state.steady_pressure.value, g.mesh.pore_pressure_0);
        for (std::size_t p = 0; p < wet.state.size(); ++p) {
            const double steady = 9810.0 * (10.0 - wet.state.position[p].y());
            const mechanics::Voigt expected =
                dry.state.stress[p] + steady * mechanics::Voigt(1.0, 1.0, 1.0, 0.0);
            EXPECT_LT((wet.state.stress[p] - expected).norm(), 1e-3)
                << wet.state.position[p].transpose();
        }
        EXPECT_NO_THROW(refuse_losses(wet.ledger, *g.scene.transfer));
    }
}

TEST(Stress, WithoutFrictionItIsAlwaysTotal) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    g.scene.transfer->stress = scene::TransferredStress::effective;
    g.scene.transfer->mapping = {{.region = 0, .material = 1}};
    const auto t = meshes::transferred(g.mesh, g.scene);
    EXPECT_EQ(t.state.stress_of_regions,
              (std::vector<StressMeasure>{StressMeasure::total, StressMeasure::effective}));
    EXPECT_EQ(t.state.materials_of_regions[0], "liquefied_1");
}

TEST(LiquefiedLayers, HoldEverythingAboveTheDeepestNodeByInitialStress) {
    // r_u = 1 at y = 4 and 5 m for x < 4 m: the soil above liquefies too. At x = 3, where half of
    // the elements have it, the mean is 0.6.
    Ground g = ground([](const Vec2& x) { return x.x() < 3.5 && std::abs(x.y() - 4.5) < 0.6; });
    g.scene.transfer->liquefied = scene::LiquefiedZone{.regions = {0},
                                                       .r_u = 0.7,
                                                       .when = scene::LiquefiedWhen::ever,
                                                       .layers = {{0.0, 36e3, 1}, {36e3, 40e3, 2}}};
    const auto t = meshes::transferred(g.mesh, g.scene);
    ASSERT_TRUE(t.liquefaction.has_value());
    EXPECT_EQ(t.liquefaction->columns->nodes, 6u);
    EXPECT_EQ(t.liquefaction->columns->deepest_level, 4.0);
    for (std::size_t p = 0; p < t.state.size(); ++p) {
        const Vec2& x = t.state.position[p];
        // Nodes at x = 0, 1, 2 represent columns to 2.5 m; 36 kPa are at 4 m depth, and the second
        // layer includes stresses above its 40 kPa.
        const bool liquefied = x.x() < 2.5 && x.y() >= 4.0;
        const std::int32_t expected = !liquefied ? (x.x() < 6.0 ? 0 : 1) : x.y() > 6.0 ? 2 : 3;
        ASSERT_EQ(t.state.region[p], expected) << x.transpose();
        if (!liquefied) continue;
        const double s_r = expected == 2 ? 3e3 : 5.6e3;
        EXPECT_LE(materials::yield_excess(undrained(s_r), {t.state.stress[p], 0.0}), 1e-6);
    }
    EXPECT_GT(t.yield.at(2).returned, 0u) << "K_0 stresses exceed the residual strength";
    EXPECT_EQ(t.shares.size(), 4u);
    EXPECT_NO_THROW(refuse_losses(t.ledger, *g.scene.transfer));
}

// A layer between 4 and 5 m by r_u and a patch by strain; what lies between and above stands, and
// so does what lies above the water table.
TEST(LiquefiedPoints, AreThoseOfTheirGaussPointsBelowTheWaterTable) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    const auto places = meshes::gauss_places(g.mesh);
    g.mesh.excess_pressure_max = g.mesh.pore_pressure_0;
    for (const Vec2& x : places) {
        g.mesh.r_u_max.push_back(x.y() > 4.0 && x.y() < 5.0 ? 0.7 : 0.69);
        g.mesh.shear_strain_max.push_back(x.x() < 2.0 && x.y() > 8.0 ? 0.08 : 0.01);
    }
    g.scene.transfer->phreatic_line = {{0.0, 9.0}};
    g.scene.transfer->liquefied = scene::LiquefiedZone{.regions = {0},
                                                       .r_u = 0.7,
                                                       .when = scene::LiquefiedWhen::ever,
                                                       .by = scene::LiquefiedBy::point,
                                                       .shear_strain = 0.08,
                                                       .layers = {{0.0, 1e6, 1}}};
    const auto t = meshes::transferred(g.mesh, g.scene);
    double share = 0.0;
    for (std::size_t p = 0; p < t.state.size(); ++p) {
        const Vec2& x = t.state.position[p];
        const bool by_pressure = x.y() > 4.0 && x.y() < 5.0;
        const bool by_strain = x.x() < 2.0 && x.y() > 8.0 && x.y() < 9.0;
        const bool liquefied = x.x() < 6.0 && (by_pressure || by_strain);
        ASSERT_EQ(t.state.region[p], liquefied ? 2 : x.x() < 6.0 ? 0 : 1) << x.transpose();
        share += liquefied ? 1.0 / (4 * 60) : 0.0;
    }
    EXPECT_NEAR(t.liquefaction->share.at(g.mesh.regions[0]), share, 1e-12);
    EXPECT_FALSE(t.liquefaction->columns);
    g.mesh.r_u_max.clear();
    g.mesh.shear_strain_max.clear();
    EXPECT_THROW(transfer(g.mesh, g.scene, {}, "snapshot"), fault::BadInput);
}

// Liquefied below y = 6 m everywhere; the water table falls through the elements, over dry soil.
TEST(LiquefiedLayers, EndAtTheWaterTableOfTheMappingOrOfTheFemWhenItShakes) {
    const std::vector<Vec2> table{{0.0, 8.3}, {12.0, 5.9}};
    Ground g = ground([](const Vec2& x) { return x.y() < 6.1 ? 1.0 : 0.0; });
    g.scene.transfer->liquefied =
        scene::LiquefiedZone{.regions = {0, 1},
                             .r_u = 0.7,
                             .when = scene::LiquefiedWhen::ever,
                             .layers = {{0.0, 36e3, 1}, {36e3, 40e3, 2}},
                             .lines = {{.transfer_time = 0.0, .points = {{{0, 2}, {12, 2}}}}}};
    g.mesh.time = 0.0;
    scene::Scene shaken = g.scene;
    g.scene.transfer->phreatic_line = table;
    // A line that rises before the shaking, and a mapping that says otherwise.
    shaken.transfer->phreatic_line = {{0.0, 2.0}};
    shaken.fem.emplace();
    shaken.fem->water.emplace();
    shaken.fem->water->line = {{0.0, 1.0}};
    using enum scene::StageKind;
    shaken.fem->stages = {
        {.name = "rise", .kind = static_equilibrium, .laws = {}, .phreatic_line = table},
        {.name = "shaking", .kind = dynamic, .laws = {}}};
    for (const scene::Scene& each : {g.scene, shaken}) {
        const auto t = meshes::transferred(g.mesh, each);
        for (std::size_t p = 0; p < t.state.size(); ++p) {
            const Vec2& x = t.state.position[p];
            const bool wet = x.y() < 8.3 - 0.2 * x.x();
            const bool liquefied = t.state.materials_of_regions[t.state.region[p]] != "soil";
            ASSERT_EQ(liquefied, wet) << x.transpose();
        }
    }
}

TEST(LiquefiedLayers, NeedASnapshotThatKnowsTheStressBefore) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    g.scene.transfer->liquefied = scene::LiquefiedZone{
        .regions = {0}, .r_u = 0.7, .when = scene::LiquefiedWhen::ever, .layers = {{0.0, 36e3, 1}}};
    g.mesh.sigma_v0.clear();
    g.mesh.pore_pressure_0.clear();
    EXPECT_THROW(transfer(g.mesh, g.scene, {}, "snapshot"), fault::BadInput);
}

TEST(PhreaticLine, PartsSaturatedFromUnsaturatedSoil) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    g.scene.transfer->phreatic_line = {{6.0, 8.0}, {12.0, 2.0}};
    g.scene.transfer->mapping = {{.region = 1, .material = 0, .saturated = 3}};
    const auto t = meshes::transferred(g.mesh, g.scene);
    std::size_t wet = 0;
    for (std::size_t p = 0; p < t.state.size(); ++p) {
        const Vec2& x = t.state.position[p];
        const bool saturated = x.x() > 6.0 && x.y() < 14.0 - x.x();
        EXPECT_EQ(t.state.materials_of_regions[t.state.region[p]], saturated ? "wet" : "soil");
        wet += saturated ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(wet) / 4.0, 30.0, 1.5) << "elements of 1 m2 below the line";
}

// The file agrees with the MPM: layers of one region have their own laws.
TEST(LiquefiedLayers, HaveTheirOwnLawsInTheMpm) {
    Ground g = ground([](const Vec2& x) { return x.y() > 4.9; });
    g.scene.transfer->liquefied = scene::LiquefiedZone{.regions = {0},
                                                       .r_u = 0.7,
                                                       .when = scene::LiquefiedWhen::ever,
                                                       .layers = {{0.0, 20e3, 1}, {20e3, 50e3, 2}}};
    g.scene.mpm = meshes::cells(1.0, 12.0, 20.0);
    g.scene.mpm->stiffness_scale = 1.0;
    const auto t = meshes::transferred(g.mesh, g.scene);
    const auto zoned = mpm::zoned_points(g.scene, t.state, "particles");
    ASSERT_EQ(zoned.zones.size(), 3u);
    for (const auto& share : t.shares) {
        std::size_t held = 0;
        for (const std::int32_t region : zoned.points.region)
            held += region == static_cast<std::int32_t>(share.soil) ? 1 : 0;
        EXPECT_EQ(held, share.points);
    }
    auto with_water_beside = t.state;
    with_water_beside.stress_of_regions.assign(t.state.regions.size(), StressMeasure::effective);
    EXPECT_THROW(mpm::zoned_points(g.scene, with_water_beside, "particles"), fault::BadInput);
}

TEST(Pm4Sand, MustBeMappedToALawThatParticlesCanHave) {
    Ground g = ground([](const Vec2&) { return 0.0; });
    g.scene.materials[0].law = materials::PM4Sand{};
    try {
        transfer(g.mesh, g.scene, {}, "snapshot");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_EQ(refusal.faults().size(), 2u) << "both regions";
        EXPECT_NE(std::string(refusal.what()).find("/transfer/mapping"), std::string::npos);
    }
    g.scene.transfer->mapping = {{.region = 0, .material = 3}, {.region = 1, .material = 3}};
    EXPECT_NO_THROW(meshes::transferred(g.mesh, g.scene));
}

}  // namespace
}  // namespace breach::transfer::water_test
