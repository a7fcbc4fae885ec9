// The unbalanced force of the new points on the MPM's grid.
#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::balance_test {
namespace {

constexpr double rho = 1800.0;
constexpr double g = 9.81;

/// Level ground, 8 m by 10 m in elements of 1 m; effective stress and water in equilibrium with its
/// weight.
meshes::MeshSnapshot level_ground(double water_level) {
    auto mesh = meshes::grid({.nx = 8, .ny = 10, .width = 8.0, .height = 10.0});
    meshes::soak(mesh, water_level, [](const auto&) { return 0.0; });
    const auto places = meshes::gauss_places(mesh);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double u = 9810.0 * (water_level - places[i].y());
        const double sigma_v = -rho * g * (10.0 - places[i].y()) + u;
        mesh.stress[i] = {0.4 * sigma_v, sigma_v, 0.4 * sigma_v, 0.0};
    }
    return mesh;
}

exchange::LedgerRow balance(const meshes::MeshSnapshot& mesh, double half_size,
                            scene::TransferredStress stress, const materials::Law& law) {
    auto how = meshes::settings(2);
    how.stress = stress;
    auto scene = meshes::scene_for(mesh, law, how);
    scene.mpm = meshes::cells(1.0, 8.0, 20.0, half_size);
    return meshes::row_of(meshes::transferred(mesh, scene).ledger, "total", "out-of-balance force");
}

// Hat functions, elements equal to the cells, stress linear in depth: Gauss points integrate the
// nodal equations exactly, so level ground stays at rest to round-off of its weight.
TEST(Balance, LevelGroundWithWaterIsInEquilibriumOnTheGrid) {
    const auto mesh = level_ground(10.0);
    for (const auto stress :
         {scene::TransferredStress::total, scene::TransferredStress::effective}) {
        const auto row = balance(mesh, meshes::hat, stress, meshes::frictional);
        std::cout << "  out of balance " << row.difference << " of the weight, allowed 1e-12\n";
        EXPECT_LT(std::abs(row.difference), 1e-12);
    }
}

// GIMP averages the same stresses: the unbalanced force is the quadrature error of 2 x 2 points per
// cell, and must be small compared with the effect of losing the water.
TEST(Balance, LosingTheWaterWouldShow) {
    const auto mesh = level_ground(10.0);
    auto dry = mesh;
    dry.pore_pressure.clear();
    dry.pore_pressure_0.clear();
    dry.sigma_v0.clear();
    const auto total = scene::TransferredStress::total;
    const auto with = balance(mesh, 0.25, total, meshes::elastic);
    const auto without = balance(dry, 0.25, total, meshes::elastic);
    std::cout << "  out of balance " << with.difference << " of the weight, without water "
              << without.difference << "\n";
    EXPECT_LT(with.difference, 0.1);
    EXPECT_GT(without.difference, 0.4) << "9.81 of 17.66 kN/m3 carried by nothing";
}

// A body in free fall: without stress, the force is the weight, which the acceleration needs.
TEST(Balance, TheInertiaOfTheFemIsTheReference) {
    auto mesh = meshes::grid({.nx = 8, .ny = 10, .width = 8.0, .height = 10.0});
    for (auto& x : mesh.position_0) x.y() += 5.0;  // above the floor
    for (auto& a : mesh.acceleration) a = {0.0, -g};
    const auto row = balance(mesh, 0.25, scene::TransferredStress::total, meshes::elastic);
    EXPECT_NEAR(row.before / (rho * 80.0 * 1.5 * g), 1.0, 1e-12);
    EXPECT_LT(std::abs(row.difference), 1e-12);
}

TEST(Balance, RegionsAddUpToTheTotal) {
    auto mesh = meshes::grid({.skew = 0.2, .regions = 3});
    meshes::set_in_motion(mesh);
    for (auto& a : mesh.acceleration) a = {1.0, -2.0};
    auto scene = meshes::scene_for(mesh, meshes::elastic, meshes::settings(2));
    scene.mpm = meshes::cells(1.0, 20.0, 20.0);
    const auto ledger = meshes::transferred(mesh, scene).ledger;
    double sum = 0.0;
    for (const char* region : {"strip 0", "strip 1", "strip 2"})
        sum += meshes::row_of(ledger, region, "out-of-balance force").after;
    EXPECT_NEAR(sum / meshes::row_of(ledger, "total", "out-of-balance force").after, 1.0, 1e-12);
}

TEST(Balance, WithoutAnMpmThereIsNoGridToBalanceOn) {
    const auto mesh = meshes::grid({});
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, meshes::settings(2)));
    EXPECT_THROW(meshes::row_of(t.ledger, "total", "out-of-balance force"), std::logic_error);
}

}  // namespace
}  // namespace breach::transfer::balance_test
