// Mass, volume, momentum and energies: exact integrals over the mesh against sums over the points.
#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::conservation_test {
namespace {

using exchange::Ledger;

double difference(const Ledger& ledger, const std::string& region, const std::string& quantity) {
    for (const auto& row : ledger)
        if (row.region == region && row.quantity == quantity) return std::abs(row.difference);
    ADD_FAILURE() << "no row " << region << ", " << quantity;
    return 1.0;
}

double before(const Ledger& ledger, const std::string& quantity) {
    for (const auto& row : ledger)
        if (row.region == "total" && row.quantity == quantity) return row.before;
    return 0.0;
}

class DistortedMesh : public testing::TestWithParam<int> {};

// With n >= 2 points per direction every integrand (degree at most 3 in xi and in eta) is
// integrated exactly: what remains is the round-off of some hundred additions. Limits: 1e-12 and
// 1e-10.
TEST_P(DistortedMesh, KeepsMassVolumeMomentumAndEnergiesInEveryRegion) {
    auto mesh = meshes::grid({.nx = 9, .ny = 7, .skew = 0.2, .regions = 3});
    meshes::set_in_motion(mesh);
    const auto how = meshes::settings(GetParam());
    const auto t = meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, how), 1);
    for (const std::string region : {"strip 0", "strip 1", "strip 2", "total"}) {
        EXPECT_LT(difference(t.ledger, region, "mass"), 1e-12);
        EXPECT_LT(difference(t.ledger, region, "volume"), 1e-12);
        EXPECT_LT(difference(t.ledger, region, "momentum x"), 1e-10);
        EXPECT_LT(difference(t.ledger, region, "momentum y"), 1e-10);
        EXPECT_LT(difference(t.ledger, region, "kinetic energy"), 1e-12);
        EXPECT_LT(difference(t.ledger, region, "potential energy"), 1e-12);
    }
    EXPECT_NO_THROW(refuse_losses(t.ledger, how));
    double worst = 0.0;
    for (const auto& row : t.ledger)
        if (row.quantity.find("nodes") == std::string::npos)
            worst = std::max(worst, std::abs(row.difference));
    std::cout << "  largest relative difference " << worst << ", allowed 1e-12 (momentum 1e-10)\n";
}

// National grids: a Gauss-Krueger northing is 5,500 km. Nodes on 1/1024 m are exact there: only the
// transfer's own round-off remains.
TEST(Conservation, IsTheSameFarFromTheOrigin) {
    auto near = meshes::grid({.nx = 9, .ny = 7, .skew = 0.2, .regions = 3});
    meshes::set_in_motion(near);
    const auto rounded = [](mechanics::Vec2& x) { x = (1024.0 * x).array().round() / 1024.0; };
    for (auto& x : near.position_0) rounded(x);
    for (auto& u : near.displacement) rounded(u);
    const auto how = meshes::settings(2);
    const auto scene = meshes::scene_for(near, meshes::frictional, how);
    const auto reference = meshes::transferred(near, scene);
    for (const mechanics::Vec2& away :
         {mechanics::Vec2{5e5, 1500.0}, mechanics::Vec2{5.5e6, 4e5}}) {
        auto far = near;
        for (auto& x : far.position_0) x += away;
        const auto t = meshes::transferred(far, scene);
        EXPECT_NO_THROW(refuse_losses(t.ledger, how));
        ASSERT_EQ(t.state.size(), reference.state.size());
        for (std::size_t p = 0; p < t.state.size(); ++p) {
            EXPECT_EQ(t.state.mass[p], reference.state.mass[p]);
            EXPECT_EQ(t.state.volume[p], reference.state.volume[p]);
            EXPECT_LT((t.state.position[p] - away - reference.state.position[p]).norm(), 4e-9);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(PointsPerDirection, DistortedMesh, testing::Values(2, 3, 4, 8));

TEST(Conservation, TheFemsRowSumMassHasTheSameMassAndMomentum) {
    auto mesh = meshes::grid({.skew = 0.2, .regions = 2});
    meshes::set_in_motion(mesh);
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, meshes::settings(2)), 1);
    EXPECT_LT(difference(t.ledger, "total", "mass of the nodes"), 1e-12);
    EXPECT_LT(difference(t.ledger, "total", "momentum x of the nodes"), 1e-10);
    EXPECT_LT(difference(t.ledger, "total", "momentum y of the nodes"), 1e-10);
}

// A rectangle b x h in rigid translation v at height y: every entry of the ledger in closed form.
TEST(Conservation, ARectangleInTranslationHasTheTextbookAmounts) {
    auto mesh = meshes::grid({.width = 12.0, .height = 10.0});
    for (auto& v : mesh.velocity) v = {3.0, -4.0};
    for (auto& sigma : mesh.stress) sigma = {-1e5, -1e5, -1e5, 0.0};
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, meshes::settings(2)), 1);
    const double V = 12.0 * 10.0 * 1.5;
    const double m = 1800.0 * V;
    EXPECT_NEAR(before(t.ledger, "mass") / m, 1.0, 1e-13);
    EXPECT_NEAR(before(t.ledger, "volume") / V, 1.0, 1e-13);
    EXPECT_NEAR(before(t.ledger, "momentum x") / (3.0 * m), 1.0, 1e-13);
    EXPECT_NEAR(before(t.ledger, "momentum y") / (-4.0 * m), 1.0, 1e-13);
    EXPECT_NEAR(before(t.ledger, "kinetic energy") / (12.5 * m), 1.0, 1e-13);
    EXPECT_NEAR(before(t.ledger, "potential energy") / (m * 9.81 * 5.0), 1.0, 1e-13);
    const double K = meshes::elastic.elasticity.bulk_modulus();  // energy p^2 / (2 K) per volume
    EXPECT_NEAR(before(t.ledger, "elastic energy") / (1e10 / (2.0 * K) * V), 1.0, 1e-13);
    EXPECT_LT(difference(t.ledger, "total", "elastic energy"), 1e-12);
}

// 360,000 equal points: the sums keep the ledger's digits.
TEST(Conservation, ManyPointsDoNotDegradeTheSums) {
    auto mesh = meshes::grid({.nx = 300, .ny = 300});
    for (auto& v : mesh.velocity) v = {0.1, -0.7};
    Points points = meshes::points_on(mesh, 2);
    carry_nodal_fields(mesh, points);
    const auto scene = meshes::scene_for(mesh, meshes::elastic, meshes::settings(2));
    const auto ledger = ledger_of(mesh, points, SoilMap(mesh, scene, "mesh"), scene, "mesh");
    for (const std::string quantity : {"mass", "volume", "momentum x", "momentum y"})
        EXPECT_LT(difference(ledger, "total", quantity), 1e-14) << quantity;
}

// One point per element cannot represent the momentum of a trapezoid; the ledger shows it.
TEST(Conservation, OnePointPerElementIsCaughtByTheLedger) {
    auto mesh = meshes::grid({.skew = 0.2});
    meshes::set_in_motion(mesh);
    const auto how = meshes::settings(1);
    const auto t = meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, how), 1);
    EXPECT_LT(difference(t.ledger, "total", "mass"), 1e-12);
    EXPECT_THROW(refuse_losses(t.ledger, how), fault::Breakdown);
}

TEST(Conservation, PointsAtTheFemsOwnGaussPointsKeepStressBitForBit) {
    auto mesh = meshes::grid({.skew = 0.2, .regions = 2});
    for (std::size_t g = 0; g < mesh.stress.size(); ++g)
        mesh.stress[g] = {-1e4 * std::sin(double(g)), -2e4, -1e4 / 3.0, 1e3 * double(g % 7)};
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, meshes::settings(2)), 2);
    EXPECT_EQ(t.state.stress, mesh.stress);
}

TEST(Conservation, ThreadsDoNotChangeABit) {
    auto mesh = meshes::grid({.skew = 0.2, .regions = 2});
    meshes::set_in_motion(mesh);
    for (std::size_t g = 0; g < mesh.stress.size(); ++g)
        mesh.stress[g] = {-1e4 * std::sin(double(g)), -2e4, -1e4 / 3.0, 1e3 * double(g % 7)};
    const auto scene = meshes::scene_for(mesh, meshes::frictional, meshes::settings(3));
    const auto one = meshes::transferred(mesh, scene, 1);
    const auto three = meshes::transferred(mesh, scene, 3);
    EXPECT_EQ(one.state.stress, three.state.stress);
    EXPECT_EQ(one.state.volume_0, three.state.volume_0);
}

}  // namespace
}  // namespace breach::transfer::conservation_test
