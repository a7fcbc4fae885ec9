// Single elements: patch test, zero-energy modes, volumetric constraint, and nu close to 1/2.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::element_test {
namespace {

using bench::expect_error;
using nlohmann::json;

Corners distorted() {
    Corners x;
    x << 0.0, 1.2, 1.5, -0.2,  //
        0.0, 0.1, 1.1, 0.8;
    return x;
}

Quadrature quadrature_of(const Corners& x) {
    Gradients gradients;
    Quadrature quadrature;
    evaluate_gradients(x, 1.0, gradients);
    evaluate_quadrature(gradients, quadrature);
    return quadrature;
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

TEST(Element, PassesThePatchTestToRoundOff) {
    json scene = bench::scene_of({.width = 0.24, .height = 0.12, .gravity = 0.0});
    const scene::Scene parsed = bench::parse(scene);
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
    double stress_error = 0.0;
    for (const State& point : trial.points) {
        stress_error = std::max(stress_error, (point.sigma - exact).norm() / exact.norm());
    }
    const double inner = trial.force.tail(8).norm() / trial.force.norm();
    // Round-off of sums over about twenty terms.
    expect_error("patch: stress at every point", stress_error, 1e-14);
    expect_error("patch: out-of-balance force at inner nodes", inner, 1e-14);
}

TEST(Element, HasExactlyThreeZeroEnergyModes) {
    for (const double nu : {0.0, 0.3, 0.4999}) {
        const Stiffness K = elastic_stiffness(quadrature_of(distorted()), {1.0, nu});
        const Dofs8 eigenvalues = Eigen::SelfAdjointEigenSolver<Stiffness>(K).eigenvalues();
        const double largest = eigenvalues[7];
        expect_error("third smallest eigenvalue over the largest",
                     std::abs(eigenvalues[2]) / largest, 1e-13);
        // G determines the softest deformation mode, K the largest eigenvalue.
        const mechanics::Elasticity soil{1.0, nu};
        EXPECT_GT(eigenvalues[3], 0.05 * soil.shear_modulus()) << "nu = " << nu;
    }
}

TEST(Element, HasOneVolumetricConstraint) {
    const Quadrature q = quadrature_of(distorted());
    for (std::size_t g = 1; g < gauss_points; ++g) {
        const auto trace = [&](std::size_t i) { return (q.B[i].row(0) + q.B[i].row(1)).eval(); };
        EXPECT_LT((trace(g) - trace(0)).norm(), 1e-14 * trace(0).norm());
    }
}

/// Tip deflection of Cook's trapezoid (48 x 44/60 m, E 1, unit end shear) with n x n quads.
double cook_deflection(int n, double nu) {
    const json scene = {
        {"format", "breachline-scene/1"},
        {"name", "cook"},
        {"gravity", 0},
        {"materials",
         {{"m",
           {{"density", 2000}, {"law", {{"type", "linear_elastic"}, {"E_MPa", 1}, {"nu", nu}}}}}}},
        {"section",
         {{"regions",
           {{{"name", "cook"},
             {"material", "m"},
             {"polygon", {{0, 0}, {48, 44}, {48, 60}, {0, 44}, {0, 0}}},
             {"mesh", {{"type", "block"}, {"divisions", {n, n}}}}}}}}},
        {"fem",
         {{"supports", {{{"name", "wall"}, {"from", {0, 0}}, {"to", {0, 44}}, {"fixes", "xy"}}}},
          {"stages", {{{"type", "static"}, {"name", "load"}}}},
          {"crest", {48, 60}}}}};
    scene::Scene parsed = bench::parse(scene);
    parsed.materials[0].law = materials::LinearElastic{{1.0, nu}};  // no soil: set after the checks
    Model model = bench::model_of(parsed);
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const Vec2 x = model.mesh.nodes[i];
        if (x.x() < 48.0 - 1e-9) continue;
        const bool end = x.y() < 44.0 + 1e-9 || x.y() > 60.0 - 1e-9;
        model.external_force[static_cast<Eigen::Index>(2 * i + 1)] = (end ? 0.5 : 1.0) / n;
    }
    Seconds seconds;
    Newton newton(model, Solved::displacement, {1e-10, 20}, Symmetry::symmetric, seconds);
    const Motion old = at_rest(model);
    Motion trial = old;
    Prediction prediction = prediction_for(model);
    static_step(newton, model, laws_for(model, scene::StageLaws::elastic), 1.0, old.force, old,
                prediction, trial);
    return trial.u[static_cast<Eigen::Index>(2 * nearest_node(model.mesh, {48, 60}) + 1)];
}

TEST(Element, DoesNotLockInCooksMembrane) {
    // Nearly incompressible plane strain, E = 1, end load 1; the finest mesh is the reference.
    const double reference = cook_deflection(64, 0.4999);
    std::printf("    Cook, nu 0.4999: n = 64 gives %.4f\n", reference);
    double before = 0.0;
    for (const int n : {8, 16, 32}) {
        const double deflection = cook_deflection(n, 0.4999);
        std::printf("    n = %3d  %.4f  (%.2f %% of the finest)\n", n, deflection,
                    100.0 * deflection / reference);
        EXPECT_GT(deflection, before);
        before = deflection;
    }
    expect_error("Cook at 32 x 32 against 64 x 64", std::abs(before / reference - 1.0), 0.01);
    expect_error("Cook at 8 x 8 against 64 x 64",
                 std::abs(cook_deflection(8, 0.4999) / reference - 1.0), 0.08);
}

}  // namespace
}  // namespace breach::fem::element_test
