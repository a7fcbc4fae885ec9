// Meshes and fields in extreme cases.
#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::extremes_test {
namespace {

using mechanics::Vec2;
using scene::Interpolation;

double linear(const Vec2& x, int) { return -18e3 * (10.0 - x.y()) + 2e3 * x.x(); }

scene::Transfer rebuilding(int n) {
    auto how = meshes::settings(n);
    how.entangled = scene::Entangled::rebuild;
    return how;
}

/// Element 7 of 6 x 5 is turned inside out by its upper right corner, node 16.
meshes::MeshSnapshot with_inverted_element() {
    auto mesh = meshes::grid({.skew = 0.1});
    mesh.displacement[16] = {-2.5, -2.5};
    return mesh;
}

TEST(Rebuild, AnInvertedElementGetsItsUndistortedShapeAndIsReported) {
    const auto mesh = with_inverted_element();
    const auto t =
        meshes::transferred(mesh, meshes::scene_for(mesh, meshes::elastic, rebuilding(2)));
    ASSERT_FALSE(t.rebuilt.empty());
    const auto seven = std::ranges::find(t.rebuilt, 7u, &RebuiltElement::element);
    ASSERT_NE(seven, t.rebuilt.end());
    EXPECT_LE(seven->least, 0.0);
    EXPECT_NEAR(seven->area, corner_jacobians(undeformed_corners(mesh, 7)).sum(), 1e-12);
    for (const double volume : t.state.volume) EXPECT_GT(volume, 0.0);
    EXPECT_NO_THROW(refuse_losses(t.ledger, rebuilding(2)));
    EXPECT_LT(std::abs(meshes::row_of(t.ledger, "total", "mass").difference), 1e-12);
}

TEST(Rebuild, LeavesSoundElementsAlone) {
    auto mesh = meshes::grid({.skew = 0.2});
    meshes::set_in_motion(mesh);
    const auto refused = shapes_of_elements(mesh, scene::Entangled::refuse, "mesh");
    const auto rebuilt = shapes_of_elements(mesh, scene::Entangled::rebuild, "mesh");
    EXPECT_TRUE(rebuilt.rebuilt.empty());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        EXPECT_EQ(refused.corners[e], rebuilt.corners[e]);
}

// A quad folded over one corner while the whole mesh rotates by 40 degrees: its shape rotates with
// it.
TEST(Rebuild, TurnsTheShapeWithTheElement) {
    auto mesh = meshes::grid({.nx = 1, .ny = 1, .width = 2.0, .height = 1.0});
    const double a = 40.0 * 3.14159265358979 / 180.0;
    mechanics::Matrix2 R;
    R << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
    for (std::size_t i = 0; i < 4; ++i)
        mesh.displacement[i] = R * mesh.position_0[i] - mesh.position_0[i];
    mesh.displacement[3] += R * Vec2(-1.2, -0.9);  // corner (2, 1) to (0.8, 0.1)
    const auto shapes = shapes_of_elements(mesh, scene::Entangled::rebuild, "mesh");
    ASSERT_EQ(shapes.rebuilt.size(), 1u);
    const Vec2 bottom = shapes.corners[0].col(1) - shapes.corners[0].col(0);
    EXPECT_NEAR(bottom.norm(), 2.0, 1e-12);
    const double turned = std::atan2(bottom.y(), bottom.x());
    EXPECT_NEAR(turned, a, 0.35) << "three corners of four speak for 40 degrees";
}

TEST(Extreme, PointsOfOneGaussPerElementTakeLinearFieldsExactly) {
    auto mesh = meshes::grid({.nx = 20, .ny = 15, .skew = 0.2, .gauss = 1});
    const auto error = meshes::field_error(mesh, linear, meshes::settings(2));
    EXPECT_LT(error.largest, 1e-6);
}

TEST(Extreme, OneRowOfOneGaussElementsIsALine) {
    const auto mesh = meshes::grid({.nx = 40, .ny = 1, .width = 40.0, .height = 1.0, .gauss = 1});
    const auto along = [](const Vec2& x, int) { return 5e3 * x.x(); };
    for (const auto mode : {Interpolation::local, Interpolation::paper}) {
        const auto error = meshes::field_error(mesh, along, meshes::settings(2, mode));
        EXPECT_TRUE(std::isfinite(error.largest));
        if (mode == Interpolation::local) {
            EXPECT_LT(error.largest, 1e-6);
        }
    }
}

TEST(Extreme, ElementsThatLieOnEachOtherShareTheirGaussPoints) {
    auto mesh = meshes::grid({.nx = 6, .ny = 6});
    const auto twice = mesh.quads;  // every element a second time
    for (std::size_t e = 0; e < twice.size(); ++e) {
        mesh.quads.push_back(twice[e]);
        mesh.region_of_element.push_back(0);
        mesh.density.push_back(mesh.density[e]);
    }
    mesh.stress.resize(2 * mesh.stress.size(), mechanics::Voigt::Zero());
    for (const auto mode : {Interpolation::local, Interpolation::paper}) {
        const auto error = meshes::field_error(mesh, linear, meshes::settings(3, mode));
        EXPECT_GT(error.report.merged_centres, 0u);
        EXPECT_TRUE(std::isfinite(error.largest));
        if (mode == Interpolation::local) {
            EXPECT_LT(error.largest, 1e-5);
        }
    }
}

// Ten thousand times the stress in the next element of the same region: interpolants oscillate but
// stay finite, and known values are kept.
TEST(Extreme, AJumpOfTenThousandTimesBetweenNeighboursStaysFinite) {
    auto mesh = meshes::grid({.nx = 12, .ny = 10});
    const auto places = meshes::gauss_places(mesh);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double sigma = places[i].x() < 6.0 ? -1e2 : -1e6;
        mesh.stress[i] = {sigma, sigma, sigma, 0.0};
    }
    for (const auto mode : {Interpolation::local, Interpolation::paper}) {
        const auto t = meshes::transferred(
            mesh, meshes::scene_for(mesh, meshes::frictional, meshes::settings(3, mode)));
        for (std::size_t p = 0; p < t.state.size(); ++p) {
            ASSERT_TRUE(t.state.stress[p].allFinite());
            ASSERT_LT(materials::yield_excess(meshes::frictional, {t.state.stress[p], 0.0}), 1e-3)
                << "what swung out of the surface is back on it";
            ASSERT_LT(t.state.stress[p].cwiseAbs().maxCoeff(), 2e6) << "no swing beyond the jump";
        }
    }
}

TEST(Stop, BothModesStopOnRequestAndReportTheirProgress) {
    const auto mesh = meshes::grid({.nx = 30, .ny = 20});
    for (const auto mode : {Interpolation::local, Interpolation::paper}) {
        const auto scene = meshes::scene_for(mesh, meshes::elastic, meshes::settings(3, mode));
        int calls = 0;
        double last = -1.0;
        const Watch watch{[&](double share) {
            EXPECT_GE(share, last);
            last = share;
            return ++calls < 3;
        }};
        EXPECT_FALSE(transfer(mesh, scene, {.threads = 2, .watch = watch}, "mesh").has_value());
        EXPECT_EQ(calls, 3);
        EXPECT_LT(last, 1.0);
    }
}

}  // namespace
}  // namespace breach::transfer::extremes_test
