// The stabilised single-point quad: operators against known numbers, patch test, zero-energy modes,
// definiteness on every convex quad, and hourglass forces that follow the soil.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "fem_solver/model/ssp_quad.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::ssp_test {
namespace {

using bench::expect_error;
using nlohmann::json;

SspGeometry geometry_of(const Corners& x) {
    SspGeometry geometry;
    evaluate_ssp(x, 1.0, geometry);
    return geometry;
}

Corners corners(std::initializer_list<Vec2> points) {
    Corners x;
    int k = 0;
    for (const Vec2& point : points) x.col(k++) = point;
    return x;
}

/// G = 1, nu = 0.3: c_s = 4.
Stiffness stiffness_of(const SspGeometry& s) {
    Eigen::Matrix3d C;
    C << 3.5, 1.5, 0, 1.5, 3.5, 0, 0, 0, 1;
    const StrainOperator B = centre_strain_operator(s.dN);
    return s.volume * B.transpose() * C * B + hourglass_stiffness(s, 4.0);
}

Dofs8 eigenvalues(const Stiffness& K) {
    return Eigen::SelfAdjointEigenSolver<Stiffness>(K).eigenvalues();
}

TEST(SspQuad, HasTheEigenvaluesOfSquareAndRectangle) {
    Dofs8 square, rectangle;
    square << 0, 0, 0, 1.0 / 3, 1.0 / 3, 2, 2, 5;
    rectangle << 0, 0, 0, .16666667, .66666667, 1.35165334, 2.5, 7.39834666;
    const Stiffness K_1 = stiffness_of(geometry_of(corners({{0, 0}, {1, 0}, {1, 1}, {0, 1}})));
    const Stiffness K_2 = stiffness_of(geometry_of(corners({{0, 0}, {2, 0}, {2, 1}, {0, 1}})));
    expect_error("unit square (docs/reference/methods/up_element.md)",
                 (eigenvalues(K_1) - square).norm(), 1e-14);
    expect_error("2 x 1 rectangle (eight decimals)", (eigenvalues(K_2) - rectangle).norm(), 2e-8);
}

TEST(SspQuad, HasTheOperatorsOfASkewedQuad) {
    const SspGeometry s = geometry_of(corners({{0, 0}, {2, .2}, {1.8, 1.5}, {.1, 1}}));
    Gradient dN;
    dN << -.18648019, .34965035, .18648019, -.34965035,  //
        -.44289044, -.41958042, .44289044, .41958042;
    const Eigen::Vector4d gamma(.26923077, -.19230769, .23076923, -.30769231);
    expect_error("gradients of a quad", (s.dN - dN).norm(), 2e-8);
    expect_error("gamma of a quad", (s.gamma - gamma).norm(), 2e-8);
    expect_error("area of a quad", std::abs(s.volume - 2.145), 1e-14);
    Matrix2 H;  // sign of the cross term: F = c_s [[H_ss, -H_st], [-H_st, H_tt]]
    H << 1.0 / 3, 1.0 / 6, 1.0 / 6, 5.0 / 12;
    const SspGeometry p = geometry_of(corners({{0, 0}, {1, 0}, {1.5, 1}, {.5, 1}}));
    expect_error("exact hourglass form of a parallelogram", (p.H - H).norm(), 1e-14);
}

TEST(SspQuad, IsDefiniteButForRigidMotionOnEveryConvexQuad) {
    std::mt19937_64 bits(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int convex = 0;
    double least_negative = 0.0, least_fourth = 1e300;
    while (convex < 20000) {
        Corners x = corners({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        for (int i = 0; i < 8; ++i) x.data()[i] += 0.6 * uniform(bits);
        x.row(0) *= std::exp(2.0 * uniform(bits));
        bool is_convex = true;
        for (int k = 0; k < 4; ++k) {
            const Vec2 a = x.col((k + 1) % 4) - x.col(k), b = x.col((k + 3) % 4) - x.col(k);
            is_convex = is_convex && a.x() * b.y() - a.y() * b.x() > 0.01;
        }
        if (!is_convex) continue;
        ++convex;
        const Dofs8 lambda = eigenvalues(stiffness_of(geometry_of(x)));
        least_negative = std::min(least_negative, lambda[0] / lambda[7]);
        least_fourth = std::min(least_fourth, lambda[3] / lambda[7]);
    }
    std::printf("    %d random convex quads: least fourth eigenvalue %.2e of the largest\n", convex,
                least_fourth);
    expect_error("least eigenvalue over the largest, negative part", -least_negative, 1e-13);
    EXPECT_GT(least_fourth, 1e-6);
}

json ssp_scene(bench::Block block, const std::string& hourglass = "current") {
    json scene = bench::scene_of(block);
    scene["fem"]["element"] = "ssp";
    scene["fem"]["hourglass"] = hourglass;
    return scene;
}

/// Five distorted quads around one another (MacNeal & Harder 1985), inner nodes 4 to 7.
Mesh patch() {
    Mesh mesh;
    mesh.nodes = {{0, 0},       {0.24, 0},    {0.24, 0.12}, {0, 0.12},
                  {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
    mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
    mesh.region_of_element.assign(5, 0);
    return mesh;
}

TEST(SspQuad, PassesThePatchTestToRoundOff) {
    const scene::Scene parsed =
        bench::parse(ssp_scene({.width = 0.24, .height = 0.12, .gravity = 0.0}));
    Model model = build_model(parsed, patch());
    Seconds seconds;
    InternalForce internal_force(model, seconds);
    const Motion old = at_rest(model);
    Motion trial = old;
    constexpr double a = 1e-6;
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const Vec2 x = model.mesh.nodes[i];
        trial.u.segment<2>(static_cast<Eigen::Index>(2 * i)) =
            a * Vec2(x.x() + 0.5 * x.y(), 0.3 * x.x() + 2.0 * x.y());
    }
    internal_force.evaluate(laws_for(model, scene::StageLaws::elastic), old, trial);
    const Voigt exact = mechanics::elastic_stress({20e6, 0.3}, Voigt(a, 2.0 * a, 0.0, 0.8 * a));
    ASSERT_EQ(trial.points.size(), 5u);
    double stress_error = 0.0, hourglass = 0.0;
    for (std::size_t e = 0; e < 5; ++e) {
        stress_error =
            std::max(stress_error, (trial.points[e].sigma - exact).norm() / exact.norm());
        hourglass = std::max(hourglass, trial.hourglass[e].force.norm() / trial.force.norm());
    }
    const double allowed = 1e-13;  // round-off
    expect_error("patch: stress at every point", stress_error, allowed);
    expect_error("patch: hourglass force", hourglass, allowed);
    expect_error("patch: out-of-balance force at inner nodes",
                 trial.force.tail(8).norm() / trial.force.norm(), allowed);
}

TEST(SspQuad, CarriesGravityLikeTheFullQuad) {
    const bench::Block block{.width = 4.0, .height = 10.0, .columns = 4, .rows = 10};
    bench::Run run(ssp_scene(block));
    const Course& a = run.go();
    double error = 0.0;
    for (std::size_t e = 0; e < a.model.mesh.quads.size(); ++e) {
        const double depth = 10.0 - corners_of(a.model.mesh, e).row(1).mean();
        const double sigma_v = -2000.0 * 9.81 * depth;
        error = std::max(error, std::abs(a.motion.points[e].sigma[1] / sigma_v - 1.0));
    }
    expect_error("vertical stress at the centres, exact for a column", error, 1e-6);
}

/// One element, base fixed, top nodes moved in opposite directions: pure hourglass mode in x, with
/// a shear that makes the soil yield.
TEST(SspQuad, SoftensWithTheSoilAndItsForceStaysContinuous) {
    const json soil = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 10}, {"phi_deg", 0}};
    for (const std::string kind : {"current", "elastic"}) {
        const Model model =
            bench::model_of(bench::parse(ssp_scene({.law = soil, .gravity = 0.0}, kind)));
        Seconds seconds;
        InternalForce internal_force(model, seconds);
        const auto laws = laws_for(model, scene::StageLaws::scene);
        Motion old = at_rest(model), trial = old;
        const double elastic = old.hourglass[0].c_s;
        double largest_jump = 0.0;
        constexpr int steps = 200;
        for (int n = 1; n <= steps; ++n) {
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec2 x = model.mesh.nodes[i];
                if (x.y() < 0.5) continue;
                const auto d = static_cast<Eigen::Index>(2 * i);
                trial.u[d] = 1e-4 * n + (x.x() < 0.5 ? 2e-6 : -2e-6) * n;
            }
            internal_force.evaluate(laws, old, trial);
            const Vec2 change = trial.hourglass[0].force - old.hourglass[0].force;
            largest_jump = std::max(largest_jump, change.norm());
            std::swap(old, trial);
            trial = old;
        }
        const double c_s = old.hourglass[0].c_s / elastic;
        std::printf("    %s: c_s falls to %.3f of the elastic one, |Q| %.3g N, energy %.3g J\n",
                    kind.c_str(), c_s, old.hourglass[0].force.norm(), old.hourglass[0].energy);
        // dq = sum gamma_i du_i = 0.25 (2 x 2e-6) = 1e-6 m; dQ <= 4 G H_xx dq.
        const double G = 20e6 / 2.6;
        EXPECT_LE(largest_jump, 4.0 * G / 3.0 * 1e-6 * (1 + 1e-9));
        if (kind == "elastic") {
            EXPECT_EQ(c_s, 1.0);
            expect_error(
                "elastic: Q = 4 G H q",
                std::abs(old.hourglass[0].force.norm() / (4.0 * G / 3.0 * 1e-6 * steps) - 1.0),
                1e-12);
        } else {
            EXPECT_NEAR(c_s, 0.02, 1e-9);
        }
    }
}

}  // namespace
}  // namespace breach::fem::ssp_test
