#include "transfer_tool/sampling.hpp"

#include <gtest/gtest.h>

#include <map>

#include "core/fault/fault.hpp"
#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer {
namespace {

/// Columns of 1 m, then of 10 m; rows of 1 m: with 2 points per direction the wide ones leave empty
/// cells.
meshes::MeshSnapshot narrow_and_wide() {
    auto mesh = meshes::grid({.nx = 10, .ny = 10, .width = 10.0, .height = 10.0});
    for (auto& x : mesh.position_0) x.x() = x.x() <= 5.0 ? x.x() : 5.0 + 10.0 * (x.x() - 5.0);
    return mesh;
}

/// Points per cell of 2.5 m, counted independently.
std::map<std::pair<int, int>, int> counted(const Points& points) {
    std::map<std::pair<int, int>, int> count;
    for (const auto& x : points.state.position)
        ++count[{static_cast<int>(x.x() / 2.5), static_cast<int>(x.y() / 2.5)}];
    return count;
}

std::vector<Corners> shapes(const meshes::MeshSnapshot& mesh) {
    return shapes_of_elements(mesh, scene::Entangled::refuse, "mesh").corners;
}

TEST(Sampling, AWideElementBesideSmallCellsLeavesNoGaps) {
    const auto mesh = narrow_and_wide();
    // 10 m wide with 2 points per direction: cells 2.5 m wide stay empty.
    const Points plain = meshes::points_on(mesh, 2);
    EXPECT_LT(counted(plain).size(), 22u * 4u);

    const Sampling sampling = sampling_for_cells(shapes(mesh), {2.5, {0.0, 0.0}, 4, 2});
    const Points points = place_points(mesh, shapes(mesh), sampling);
    const auto count = counted(points);
    EXPECT_EQ(count.size(), 22u * 4u);
    for (const auto& [cell, n] : count) EXPECT_GE(n, 2);
    EXPECT_GE(points.xi.size(), 4u * 22u * 4u);
    ASSERT_TRUE(sampling.supply.has_value());
    EXPECT_EQ(sampling.supply->filled, 22u * 4u);
    EXPECT_EQ(sampling.supply->short_cells, 0u);
    EXPECT_GE(sampling.supply->least_in_filled, 2u);
    EXPECT_EQ(sampling.numbers.front(), (Numbers{2, 2})) << "small elements stay as they are";
    EXPECT_EQ(sampling.numbers.back(), (Numbers{8, 2})) << "only the long direction has more";
}

TEST(Sampling, ADeformedMeshThatFitsNoCellIsStillServed) {
    auto mesh = meshes::grid({.nx = 7, .ny = 5, .width = 40.0, .height = 9.0, .skew = 0.25});
    meshes::set_in_motion(mesh);
    for (const int asked : {1, 4, 9}) {
        const Sampling sampling = sampling_for_cells(shapes(mesh), {0.7, {-3.0, -2.0}, asked, 2});
        EXPECT_EQ(sampling.supply->short_cells, 0u) << asked;
        EXPECT_GE(sampling.supply->least_in_filled, static_cast<std::size_t>(asked / 2));
    }
}

// Elements that do not fit the cells: 2.4 evenly spaced points along a side, 5.76 in each.
TEST(Sampling, TakesHardlyMoreThanTheMeanAskedFor) {
    const auto mesh = meshes::grid({.nx = 30, .ny = 20, .width = 30.0, .height = 20.0});
    const Sampling sampling = sampling_for_cells(shapes(mesh), {1.25, {0.0, 0.0}, 9, 2});
    const Points points = place_points(mesh, shapes(mesh), sampling);
    const double per_cell = static_cast<double>(points.xi.size()) / (24.0 * 16.0);
    EXPECT_GE(per_cell, 9.0);
    EXPECT_LT(per_cell, 10.0);
    EXPECT_GE(sampling.supply->least_in_filled, 5u);
}

TEST(Sampling, MovedPointsKeepMassVolumeAndMomentum) {
    auto mesh = meshes::grid({.nx = 7, .ny = 5, .width = 40.0, .height = 9.0, .skew = 0.25});
    meshes::set_in_motion(mesh);
    const auto sums = [&](const Shift& shift) {
        Points points =
            place_points(mesh, shapes(mesh), equal_numbers(mesh.quads.size(), 2), shift);
        carry_nodal_fields(mesh, points);
        double mass = 0.0, volume = 0.0;
        Vec2 momentum = Vec2::Zero();
        for (std::size_t p = 0; p < points.state.mass.size(); ++p) {
            mass += points.state.mass[p];
            volume += points.state.volume[p];
            momentum += points.state.mass[p] * points.state.velocity[p];
        }
        return std::array{mass, volume, momentum.x(), momentum.y()};
    };
    const auto plain = sums({0.0, 0.0});
    const auto moved = sums({0.7, -0.4});
    for (std::size_t i = 0; i < plain.size(); ++i)
        EXPECT_NEAR(moved[i], plain[i], 1e-12 * std::abs(plain[0])) << i;
}

TEST(Sampling, TooManyPointsAreRefusedBeforeTheyAreMade) {
    const auto mesh = narrow_and_wide();
    EXPECT_THROW(sampling_for_cells(shapes(mesh), {1e-3, {0.0, 0.0}, 4, 2}), fault::BadInput);
}

TEST(Sampling, TheLedgerIsExactWithAnyNumbers) {
    auto mesh = narrow_and_wide();
    meshes::set_in_motion(mesh);
    auto how = meshes::settings(2);
    how.points_per_cell = 4;
    auto scene = meshes::scene_for(mesh, meshes::elastic, how);
    scene.mpm = meshes::cells(2.5, 60.0, 20.0);
    const auto t = meshes::transferred(mesh, scene);
    EXPECT_NO_THROW(refuse_losses(t.ledger, how));
    EXPECT_GT(t.state.size(), 4 * mesh.quads.size());
}

}  // namespace
}  // namespace breach::transfer
