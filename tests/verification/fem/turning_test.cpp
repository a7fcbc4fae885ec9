// Updated Lagrangian kinematics: stresses rotate with the body, exactly and without growing.
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/verification/fem/begun_element.hpp"

namespace breach::fem::turning_test {
namespace {

using bench::expect_error;
using std::numbers::pi;

Model square() {
    Model model =
        bench::model_of(bench::parse(bench::scene_of({.columns = 2, .rows = 2, .gravity = 0.0})));
    model.kinematics = scene::Kinematics::updated_lagrangian;
    return model;
}

TEST(MovingMesh, TurnsStressExactlyWithARigidRotation) {
    const Model model = square();
    Seconds seconds;
    InternalForce internal_force(model, seconds);
    const auto laws = laws_for(model, scene::StageLaws::elastic);
    const Voigt sigma(-100e3, -300e3, -120e3, 40e3);
    Motion motion = at_rest(model), trial = motion;
    for (State& point : motion.points) point.sigma = sigma;
    constexpr int steps = 8;  // 11.25 degrees each: also exact for large angles
    const double angle = 0.5 * pi / steps;
    for (int n = 1; n <= steps; ++n) {
        const mechanics::Matrix2 R = Eigen::Rotation2Dd(n * angle).toRotationMatrix();
        for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
            const Vec2 x = model.mesh.nodes[i];
            trial.u.segment<2>(static_cast<Eigen::Index>(2 * i)) = R * x - x;
        }
        internal_force.evaluate(laws, motion, trial);
        std::swap(motion, trial);
    }
    const Voigt turned = mechanics::rotated_stress(sigma, 0.5 * pi);
    double error = 0.0;
    for (const State& point : motion.points) error = std::max(error, (point.sigma - turned).norm());
    expect_error("stress after a quarter turn in 8 steps", error / sigma.norm(), 1e-13);
    double strain = 0.0;
    for (const Voigt& epsilon : motion.strain) strain = std::max(strain, epsilon.norm());
    expect_error("strain of a rigid rotation", strain, 1e-13);
}

TEST(MovingMesh, AddsLogarithmicStrainsInExtension) {
    const Model model = square();
    Seconds seconds;
    InternalForce internal_force(model, seconds);
    const auto laws = laws_for(model, scene::StageLaws::elastic);
    const auto strain_after = [&](int steps) {
        Motion motion = at_rest(model), trial = motion;
        for (int n = 1; n <= steps; ++n) {
            for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
                trial.u[static_cast<Eigen::Index>(2 * i)] = model.mesh.nodes[i].x() * n / steps;
            }
            internal_force.evaluate(laws, motion, trial);
            std::swap(motion, trial);
        }
        return motion.strain[0][0];
    };
    const double coarse = std::abs(strain_after(10) - std::log(2.0));
    const double fine = std::abs(strain_after(20) - std::log(2.0));
    expect_error("doubled length in 20 steps against ln 2", fine, 2e-4);
    expect_error("order of the midpoint rule: |order - 2|",
                 std::abs(std::log2(coarse / fine) - 2.0), 0.02);
}

const nlohmann::json laws_with_memory = nlohmann::json::array(
    {{{"type", "pm4sand"}, {"D_R", 0.35}, {"G_0", 476}, {"h_po", 2.7}}, bench::cj1(0.05)});

/// An element under level-ground stress on a moving mesh, sheared cyclically while it rotates.
struct TurningElement : bench::BegunElement {
    explicit TurningElement(const nlohmann::json& law)
        : BegunElement(moving(law), Voigt(-70e3, -100e3, -70e3, 0.0)) {}
    static nlohmann::json moving(const nlohmann::json& law) {
        nlohmann::json scene = bench::scene_of({.law = law, .gravity = 0.0});
        scene["fem"]["kinematics"] = "updated_lagrangian";
        return scene;
    }
    void go(double gamma, double angle) {
        const mechanics::Matrix2 R = Eigen::Rotation2Dd(angle).toRotationMatrix();
        ASSERT_EQ(
            move([&](const Vec2& x) -> Vec2 { return R * (x + Vec2(gamma * x.y(), 0.0)) - x; }),
            Geometry::sound);
    }
    /// Stress in the axes of the body after a path of `steps` steps.
    Voigt stress_after(int steps, const std::function<double(double)>& angle_at) {
        for (int n = 1; n <= steps; ++n) {
            const double part = static_cast<double>(n) / steps;
            go(4e-3 * std::sin(3.0 * pi * part), angle_at(part));
        }
        return mechanics::rotated_stress(now.points[0].sigma, -angle_at(1.0));
    }
};

TEST(MovingMesh, TurnsWhatLawsRememberExactlyWithARigidRotation) {
    const auto upright = [](double) { return 0.0; };
    for (const nlohmann::json& law : laws_with_memory) {
        const std::string name = law.at("type");
        const Voigt expected = TurningElement(law).stress_after(300, upright);
        // A quarter turn between two strains.
        TurningElement turned(law);
        const Voigt reached = [&] {
            for (int n = 1; n <= 150; ++n) turned.go(4e-3 * std::sin(3.0 * pi * n / 300), 0.0);
            for (int n = 1; n <= 8; ++n) turned.go(4e-3 * std::sin(1.5 * pi), 0.5 * pi * n / 8);
            for (int n = 151; n <= 300; ++n)
                turned.go(4e-3 * std::sin(3.0 * pi * n / 300), 0.5 * pi);
            return mechanics::rotated_stress(turned.now.points[0].sigma, -0.5 * pi);
        }();
        expect_error(name + " sheared, turned a quarter, sheared on: stress",
                     (reached - expected).norm() / expected.norm(), 1e-8);
        // Simultaneous: strain and rotation of a step are those at its middle, second order.
        const auto turning = [](double part) { return 0.5 * pi * part; };
        const auto error = [&](int steps) {
            return (TurningElement(law).stress_after(steps, turning) -
                    TurningElement(law).stress_after(steps, upright))
                       .norm() /
                   expected.norm();
        };
        const double coarse = error(300), fine = error(600);
        expect_error(name + " turned a quarter while sheared in 600 steps: stress", fine, 1e-5);
        expect_error(name + " the same: error against that of 300 steps", fine / coarse, 0.3);
    }
}

}  // namespace
}  // namespace breach::fem::turning_test
