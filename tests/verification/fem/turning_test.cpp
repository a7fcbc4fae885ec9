// Updated Lagrangian kinematics: stresses turn with the body, exactly and without growing.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem {
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
    constexpr int steps = 8;  // 11.25 degrees each: a large angle is no approximation
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

}  // namespace
}  // namespace breach::fem
