// Fields that are transferred exactly on any mesh.
#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::exactness_test {
namespace {

using mechanics::Vec2;
using meshes::field_error;
using scene::Interpolation;

double constant(const Vec2&, int) { return -75e3; }
double linear(const Vec2& x, int) { return -18e3 * (10.0 - x.y()) + 2e3 * x.x(); }
/// Linear in each region, with a jump of 1e4 times between neighbours.
double jump(const Vec2& x, int region) { return linear(x, region) * std::pow(10.0, 4 * region); }

void expect_exact(const meshes::MeshSnapshot& mesh, const meshes::Field& field,
                  const scene::Transfer& how, double allowed) {
    const auto error = field_error(mesh, field, how);
    std::cout << "  largest error " << error.largest << " Pa, allowed " << allowed << " Pa\n";
    EXPECT_LT(error.largest, allowed);
}

TEST(LocalMode, ConstantAndLinearFieldsAreExactOnADistortedDeformedMesh) {
    auto mesh = meshes::grid({.nx = 12, .ny = 10, .skew = 0.2, .regions = 2});
    meshes::set_in_motion(mesh);
    // Stresses to 2e5 Pa: 1e-6 Pa is 5e-12 of them.
    expect_exact(mesh, constant, meshes::settings(3), 1e-6);
    expect_exact(mesh, linear, meshes::settings(3), 1e-6);
    expect_exact(mesh, linear, meshes::settings(5), 1e-6);
}

TEST(LocalMode, AJumpBetweenRegionsLeavesNoTrace) {
    const auto mesh = meshes::grid({.nx = 12, .ny = 10, .skew = 0.1, .regions = 2});
    // The larger side is 2e9 Pa: 1e-2 Pa is 5e-12 of it; the weaker side must be as exact as
    // without a jump.
    expect_exact(mesh, jump, meshes::settings(3), 1e-2);
    const auto weak_only = [](const Vec2& x, int region) {
        return region == 0 ? jump(x, 0) : 1e4 * jump(x, 1);
    };
    const Points points = meshes::points_on(mesh, 3);
    const auto carried =
        *interpolate(mesh, meshes::at_gauss(mesh, weak_only), meshes::settings(3), {}, points);
    double largest = 0.0;
    for (std::size_t p = 0; p < points.state.size(); ++p)
        if (points.state.region[p] == 0)
            largest = std::max(largest, std::abs(carried.value(static_cast<Eigen::Index>(p), 0) -
                                                 jump(points.state.position[p], 0)));
    EXPECT_LT(largest, 1e-6);
}

TEST(LocalMode, LinearFieldsAreExactAtAspectOneToAHundred) {
    const auto mesh = meshes::grid({.nx = 10, .ny = 100, .width = 100.0, .height = 10.0});
    expect_exact(mesh, linear, meshes::settings(3), 1e-5);  // stresses to 4e5 Pa
}

TEST(LocalMode, ARegionOfOneElementIsEnough) {
    const auto mesh = meshes::grid({.nx = 3, .ny = 1, .skew = 0.1, .regions = 3});
    expect_exact(mesh, linear, meshes::settings(3), 1e-6);
    EXPECT_EQ(field_error(mesh, linear, meshes::settings(3)).report.smallest_neighbourhood, 4u);
}

TEST(LocalMode, AnElementWithOneGaussPointInARegionOfItsOwnIsConstant) {
    const auto mesh = meshes::grid({.nx = 2, .ny = 1, .regions = 2, .gauss = 1});
    expect_exact(mesh, constant, meshes::settings(2), 1e-9);
}

TEST(LocalMode, GaussPointsInALineKeepTheSlopeAlongIt) {
    const auto mesh = meshes::grid({.nx = 1, .ny = 12, .gauss = 1});
    const auto vertical = [](const Vec2& x, int) { return -18e3 * (10.0 - x.y()); };
    expect_exact(mesh, vertical, meshes::settings(2), 1e-6);
}

TEST(PaperMode, AConstantIsExact) {
    auto mesh = meshes::grid({.skew = 0.2});
    expect_exact(mesh, constant, meshes::settings(3, Interpolation::paper), 1e-9);
}

// A flattened element: its Gauss points nearly coincide, its volume is a thousandth, and nothing is
// lost.
TEST(LocalMode, AnElementSquashedToAThousandthIsStillTransferred) {
    auto mesh = meshes::grid({.nx = 4, .ny = 4});
    for (std::size_t i = 0; i < mesh.position_0.size(); ++i) {
        const double y = mesh.position_0[i].y();
        const double squashed =
            y <= 5.0 ? y : 5.0 + 1e-3 * std::min(y - 5.0, 2.5) + std::max(0.0, y - 7.5);
        mesh.displacement[i].y() = squashed - y;
    }
    expect_exact(mesh, linear, meshes::settings(3), 1e-5);
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, meshes::settings(3)));
    EXPECT_NO_THROW(refuse_losses(t.ledger, meshes::settings(3)));
}

TEST(NodalFields, ALinearVelocityKeepsItsValueAndItsGradient) {
    auto mesh = meshes::grid({.skew = 0.2});
    meshes::set_in_motion(mesh);
    mechanics::Matrix2 L;
    L << 0.5, -1.5, 2.0, 0.25;
    for (std::size_t i = 0; i < mesh.velocity.size(); ++i)
        mesh.velocity[i] = Vec2(1.0, 2.0) + L * (mesh.position_0[i] + mesh.displacement[i]);
    Points points = meshes::points_on(mesh, 3);
    carry_nodal_fields(mesh, points);
    for (std::size_t p = 0; p < points.state.size(); ++p) {
        const Vec2 exact = Vec2(1.0, 2.0) + L * points.state.position[p];
        EXPECT_NEAR((points.state.velocity[p] - exact).norm(), 0.0, 1e-12);
        EXPECT_NEAR((points.state.velocity_gradient[p] - L).norm(), 0.0, 1e-12);
    }
}

TEST(GaussFields, EquivalentStrainIsNeverNegative) {
    auto mesh = meshes::grid({.nx = 12, .ny = 12});
    const auto places = meshes::gauss_places(mesh);
    for (std::size_t g = 0; g < places.size(); ++g)  // a shear band one element wide
        mesh.epsilon_q[g] = std::abs(places[g].x() - places[g].y()) < 1.0 ? 0.5 : 0.0;
    Points points = meshes::points_on(mesh, 3);
    const GaussFieldReport report = *carry_gauss_fields(mesh, meshes::settings(3), {}, points);
    EXPECT_GT(report.raised_strains, 0u) << "the band does make the interpolant swing";
    for (const double epsilon_q : points.state.epsilon_q) EXPECT_GE(epsilon_q, 0.0);
}

}  // namespace
}  // namespace breach::transfer::exactness_test
