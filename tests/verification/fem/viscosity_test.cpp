// Additional viscosity: a column settles like the damped modes of a bar, Bingham flow between rough
// walls, and the energy balance.
#include "fem_solver/solve/viscosity.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::viscosity_test {
namespace {

using bench::expect_error;
using nlohmann::json;

constexpr double g = 9.81;

json dynamic_stage(double duration, double time_step) {
    return {
        {"type", "dynamic"}, {"name", "flow"}, {"duration", duration}, {"time_step", time_step}};
}

// ---- a column between smooth walls under sudden gravity

constexpr double H = 10.0, rho = 2000.0, E = 20e6, nu = 0.3;

json column(const char* element, double eta, double duration, double dt) {
    bench::Block block{.width = 1.0, .height = H, .columns = 1, .rows = 40};
    block.stages = json::array({dynamic_stage(duration, dt)});
    block.stages[0]["laws"] = "elastic";
    json scene = bench::scene_of(block);
    scene["materials"]["soil"]["viscosity"] = eta;
    json& fem = scene["fem"];
    fem["element"] = element;
    fem["newmark_beta"] = 0.25;
    fem["newmark_gamma"] = 0.5;
    fem["telemetry_interval"] = 0;
    fem["force_tolerance"] = 1e-10;
    return scene;
}

/// Settlement of its top: modes of the bar rho u'' = M u_yy + (4/3) eta u'_yy - rho g, each with
/// the roots of s^2 + (4 eta / 3 M) w^2 s + w^2 = 0, real if the viscosity dominates.
double settlement(double t, double eta) {
    const double M = mechanics::Elasticity{E, nu}.constrained_modulus();
    double left = 0.0;
    for (int n = 0; n < 200; ++n) {
        const double k = (n + 0.5) * std::numbers::pi / H;
        const std::complex<double> w = k * std::sqrt(M / rho);
        const std::complex<double> b = 2.0 / 3.0 * eta * k * k / rho;
        const std::complex<double> root = std::sqrt(b * b - w * w);
        const std::complex<double> fast = -b - root, slow = w * w / fast;
        const auto course = (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (fast - slow);
        left += (n % 2 == 0 ? 1.0 : -1.0) * 2.0 * g / (H * k * w.real() * w.real()) * course.real();
    }
    return rho * g * H * H / (2.0 * M) - left;
}

/// Largest error of the top's displacement, over the static or the largest settlement.
double course_error(const char* element, double eta, double duration, double dt) {
    bench::Run run(column(element, eta, duration, dt));
    double worst = 0.0, largest = 0.0;
    for (const Reading& r : run.go().history) {
        const double exact = settlement(r.time, eta);
        worst = std::max(worst, std::abs(-r.crest_dy - exact));
        largest = std::max(largest, std::abs(exact));
    }
    return worst / largest;
}

TEST(Viscosity, AColumnSwingsAndSettlesAsItsDampedModesSay) {
    // 1.5e5 Pa s: damping ratio 5 % of the first mode; 1e7: it creeps. Forty elements and 200 steps
    // per period of the first mode.
    for (const char* element : {"bbar", "ssp"}) {
        for (const double eta : {1.5e5, 1e7}) {
            expect_error(std::string(element) + ", top's course, eta " + std::to_string(eta),
                         course_error(element, eta, 1.0, 1.7e-3), 2e-3);
        }
    }
}

TEST(Viscosity, StepsOfAMicrosecondUnderTheLargestViscosityFollowTheColumn) {
    expect_error("eta 1e7 Pa s, 200 steps of 1e-6 s: top's fall",
                 course_error("ssp", 1e7, 2e-4, 1e-6), 2e-3);
}

TEST(Viscosity, StepsAThousandTimesTooLargeEndAtTheStaticSettlement) {
    // Relaxation of the first mode, 4 eta / 3 M = 0.5 s; steps of 500 s.
    json scene = column("ssp", 1e7, 2e4, 500.0);
    scene["fem"]["newmark_beta"] = 4.0 / 9.0;
    scene["fem"]["newmark_gamma"] = 5.0 / 6.0;
    bench::Run run(scene);
    const double M = mechanics::Elasticity{E, nu}.constrained_modulus();
    expect_error("settlement after 40 steps",
                 std::abs(-run.go().history.back().crest_dy * 2.0 * M / (rho * g * H * H) - 1.0),
                 1e-3);
}

// ---- soil with the strength c that flows down between two rough walls

constexpr double half_width = 1.0, c = 300.0, eta_of_flow = 2000.0, gravity = 1.0, density = 1000.0;

json channel(const char* element) {
    // One row whose nodes cannot move sideways: all heights move equally.
    bench::Block block{
        .width = 2.0 * half_width, .height = 0.1, .columns = 20, .rows = 1, .gravity = gravity};
    block.density = density;
    block.law = {{"type", "mohr_coulomb"}, {"E_MPa", 0.2}, {"nu", 0.3},
                 {"c_kPa", c / 1e3},       {"phi_deg", 0}, {"tension_cutoff_kPa", 1e6}};
    block.stages = json::array({dynamic_stage(4.0, 5e-3)});
    json scene = bench::scene_of(block);
    scene["materials"]["soil"]["viscosity"] = eta_of_flow;
    json& fem = scene["fem"];
    for (int side = 0; side < 2; ++side) fem["supports"][side]["fixes"] = "xy";
    fem["supports"][2]["fixes"] = "x";
    fem["supports"].push_back(fem["supports"][2]);
    fem["supports"][3]["name"] = "top";
    fem["supports"][3]["from"][1] = fem["supports"][3]["to"][1] = 0.1;
    fem["element"] = element;
    fem["newmark_beta"] = 0.25;
    fem["newmark_gamma"] = 0.5;
    fem["telemetry_interval"] = 0;
    fem["force_tolerance"] = 1e-9;
    return scene;
}

/// Downward velocity of the steady flow at x from the middle: a plug of half width c / (rho g).
double steady(double x) {
    const double plug = c / (density * gravity);
    const double sheared = std::max(std::abs(x), plug);
    return density * gravity / (2.0 * eta_of_flow) * (half_width * half_width - sheared * sheared) -
           c / eta_of_flow * (half_width - sheared);
}

/// Largest error of a node's velocity, over the fastest.
double velocity_error(const Course& a) {
    const Mesh& mesh = a.model.mesh;
    double worst = 0.0;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const double v = -a.motion.v[static_cast<Eigen::Index>(2 * i + 1)];
        worst = std::max(worst, std::abs(v - steady(mesh.nodes[i].x() - half_width)));
    }
    return worst / steady(0.0);
}

TEST(Viscosity, SoilOfYieldStrengthFallsAsBinghamSays) {
    for (const char* element : {"bbar", "ssp"}) {
        bench::Run run(channel(element));
        const Course& a = run.go();
        // Nodal values of the exact parabola are exact, and the plug's edge is a node.
        expect_error(std::string(element) + ", velocities over the fastest", velocity_error(a),
                     1e-6);
        double open = 0.0;
        for (const Reading& r : a.history) {
            open = std::max(open, std::abs(r.external_work - r.kinetic_energy - r.internal_work -
                                           r.viscous_dissipation));
        }
        const Reading& last = a.history.back();
        std::printf("    of %.2f J viscosity took %.2f, the stresses %.2f\n", last.external_work,
                    last.viscous_dissipation, last.internal_work);
        expect_error(std::string(element) + ", energy unaccounted for over the work of gravity",
                     open / last.external_work, 1e-6);
        // In the sheared soil tau = c + eta gamma', at the middle of elements of the width h: the
        // viscous power of each side is (rho g)^2 (s^3 / 3 - s h^2 / 12) / eta per height.
        const Reading& before = a.history.at(600);
        const double s = half_width - c / (density * gravity), h = 0.1;
        const double power = 2.0 * 0.1 * std::pow(density * gravity, 2) *
                             (s * s * s / 3.0 - s * h * h / 12.0) / eta_of_flow;
        const double taken = last.viscous_dissipation - before.viscous_dissipation;
        expect_error(std::string(element) + ", viscous power of the steady flow",
                     std::abs(taken / (power * (last.time - before.time)) - 1.0), 1e-5);
    }
}

// ---- one element

TEST(Viscosity, DampsAllMotionOfAnElementButRigidOne) {
    Corners x;
    x << 0.0, 2.0, 2.4, -0.3,  //
        0.0, 0.2, 1.7, 1.1;
    const double thickness = 1.0, eta = 3.0;
    Gradients gradients;
    Quadrature whole, centre;
    evaluate_gradients(x, thickness, gradients);
    evaluate_quadrature(gradients, whole);
    SspGeometry hourglass;
    evaluate_ssp(x, thickness, hourglass);
    use_centre_only(hourglass, gradients, centre);
    for (const ElementOperators& element : {ElementOperators{whole, gauss_points, nullptr},
                                            ElementOperators{centre, 1, &hourglass}}) {
        const Stiffness C = viscous_damping(element, eta);
        const Eigen::SelfAdjointEigenSolver<Stiffness> modes(C);
        const auto powers = modes.eigenvalues();
        EXPECT_LT(std::abs(powers[2]), 1e-13 * powers[7]) << "two shifts and a rotation";
        EXPECT_GT(powers[3], 0.02 * powers[7]) << "everything else flows";
        Dofs8 v;
        v << 0.3, -0.2, 0.5, 0.7, -0.4, 0.1, 0.2, -0.6;
        EXPECT_LT((C * v - viscous_forces(element, eta, v)).norm(), 1e-12 * (C * v).norm());
    }
}

}  // namespace
}  // namespace breach::fem::viscosity_test
