#include "transfer_tool/grid_force.hpp"

#include <gtest/gtest.h>

namespace breach::transfer {
namespace {

/// A point of 2 kg without stress at a height above the floor, in cells of 1 m.
double force_of_a_point(double height) {
    scene::Scene scene{};
    scene.gravity = 10.0;
    scene.materials.push_back(
        {.name = "soil", .density = 2000.0, .law = materials::LinearElastic{{1e6, 0.3}}});
    scene.section.regions.push_back({.name = "block", .material = 0, .polygon = {}});
    scene.mpm.emplace();
    scene.mpm->cell_size = 1.0;
    scene.mpm->domain_x = {0.0, 20.0};
    scene.mpm->domain_y = {0.0, 10.0};
    scene.mpm->gimp_half_size = 0.25;
    Points points;
    points.state.position = {{10.5, height}};
    points.state.region = {0};
    points.state.mass = {2.0};
    points.state.volume = {1e-3};
    points.state.stress = {mechanics::Voigt::Zero()};
    points.acceleration = {Vec2::Zero()};
    const auto sums = grid_force(scene, points);
    EXPECT_DOUBLE_EQ(sums.at(0).weight, 20.0);
    return sums.at(0).force;
}

TEST(GridForce, IsWeighedByTheKernelThatTheMpmUses) {
    // The floor's nodes support their share of the weight; that of the row above is unbalanced.
    // GIMP clips the point's domain [-0.05, 0.45] at the floor: its centroid is at 0.225.
    EXPECT_DOUBLE_EQ(force_of_a_point(0.2), 0.225 * 20.0);
}

}  // namespace
}  // namespace breach::transfer
