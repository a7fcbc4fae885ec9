// The loops over blocks of points against the laws point by point, for each instruction set and
// number of threads.
#include <gtest/gtest.h>

#include <random>

#include "mpm_solver/loops/turn.hpp"
#include "mpm_solver/step.hpp"
#include "tests/unit/mpm/bodies.hpp"

namespace breach::mpm::test {
namespace {

scene::Scene heap_of(const materials::Law& law, double h) {
    scene::Scene scene = one_soil(law, 1800.0, rectangle(0, 0, 6, 8), h, 20.0, 10.0);
    scene.gravity = 9.81;
    scene.mpm->left = scene::Wall::roller;
    scene.mpm->floor.friction = {{0.0, 20.0, 0.4}};
    return scene;
}

Body body_of(const scene::Scene& scene, const Computing& computing) {
    return make_body(scene, zoned_points(scene, fill_section(scene).state, "test"), "test",
                     computing);
}

void step_often(Body& body, const scene::Scene& scene, int steps) {
    for (int k = 0; k < steps; ++k) step(body, courant_step(body, scene.mpm->cfl));
}

std::vector<InstructionSet> sets_of_this_cpu() {
    std::vector<InstructionSet> sets{InstructionSet::plain};
    if (best_instruction_set() != InstructionSet::plain) sets.push_back(InstructionSet::avx2);
    if (best_instruction_set() == InstructionSet::avx512) sets.push_back(InstructionSet::avx512);
    return sets;
}

materials::MohrCoulomb soil(double phi_deg, double psi_deg, double cutoff) {
    auto law = std::get<materials::MohrCoulomb>(sand(2e7, 0.3, 5e3, phi_deg));
    law.psi = psi_deg * std::numbers::pi / 180.0;
    law.tension_cutoff = cutoff;
    return law;
}

materials::DruckerPrager smooth(double phi_deg, double psi_deg, double cutoff) {
    const materials::MohrCoulomb of = soil(phi_deg, psi_deg, cutoff);
    return {of.elasticity, of.c, of.phi, of.psi, of.tension_cutoff};
}

std::vector<materials::Law> soils() {
    materials::MohrCoulomb plastic = soil(30.0, 0.0, 0.0);
    plastic.softening = {
        .epsilon_q_start = 0.01, .epsilon_q_end = 0.1, .c_residual = 1e3, .tan_phi_residual = 0.1};
    materials::MohrCoulomb total = plastic;
    total.softening->driver = materials::SofteningDriver::total;
    return {soil(30.0, 0.0, 0.0),
            soil(30.0, 10.0, 2e3),
            soil(25.0, 5.0, std::numeric_limits<double>::infinity()),
            soil(0.0, 0.0, std::numeric_limits<double>::infinity()),
            soil(0.0, 0.0, 0.0),
            plastic,
            total,
            smooth(30.0, 0.0, 0.0),
            smooth(30.0, 10.0, 2e3),
            smooth(25.0, 25.0, std::numeric_limits<double>::infinity()),
            smooth(0.0, 0.0, std::numeric_limits<double>::infinity()),
            elastic(2e7, 0.3)};
}

/// Stresses, rates and strains of every kind: inside, on planes, edges, cut-offs and at the tip.
void shake(Points& points) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double mean = 30e3 * (any(random) - 0.7);
        points.sxx[p] = mean + 30e3 * any(random);
        points.syy[p] = mean + 30e3 * any(random);
        points.szz[p] = p % 5 == 0 ? points.sxx[p] : mean + 30e3 * any(random);
        points.sxy[p] = p % 7 == 0 ? 0.0 : 20e3 * any(random);
        points.Lxx[p] = any(random), points.Lxy[p] = any(random);
        points.Lyx[p] = any(random), points.Lyy[p] = any(random);
        points.epsilon_q_plastic[p] = 0.06 * (1.0 + any(random));
    }
}

/// The state of point p after dt by the law, without loop.
materials::State by_the_law(const materials::Law& law, const Points& points, std::size_t p,
                            double dt) {
    const InPlane<double> turned_stress = turned<double>(
        {points.sxx[p], points.syy[p], points.sxy[p]}, 0.5 * (points.Lyx[p] - points.Lxy[p]) * dt);
    const materials::State old{
        {turned_stress.xx, turned_stress.yy, points.szz[p], turned_stress.xy},
        points.epsilon_q_plastic[p]};
    const mechanics::Voigt d_epsilon{points.Lxx[p] * dt, points.Lyy[p] * dt, 0.0,
                                     (points.Lxy[p] + points.Lyx[p]) * dt};
    const auto integrated = [&](const auto& each) -> materials::State {
        if constexpr (requires { materials::integrate(each, old, d_epsilon); }) {
            return materials::integrate(each, old, d_epsilon).state;
        } else {
            throw std::logic_error("this law is not for particles");
        }
    };
    return std::visit(integrated, law);
}

TEST(Loops, UpdateStressAsTheLawDoesPointByPoint) {
    const double dt = 1e-3;
    for (const materials::Law& law : soils()) {
        scene::Scene scene = heap_of(law, 0.25);
        scene.mpm->anti_locking = scene::AntiLocking::off;
        scene.mpm->gap_closure = false;
        for (const InstructionSet instructions : sets_of_this_cpu()) {
            Body body = body_of(scene, {.instructions = instructions});
            shake(body.points);
            const Points before = body.points;
            update_stress(body, dt);
            double worst = 0.0;
            double worst_strain = 0.0;
            for (std::size_t p = 0; p < before.size(); ++p) {
                const materials::State state = by_the_law(law, before, p, dt);
                const mechanics::Voigt sigma{body.points.sxx[p], body.points.syy[p],
                                             body.points.szz[p], body.points.sxy[p]};
                worst = std::max(worst, (sigma - state.sigma).cwiseAbs().maxCoeff() / 30e3);
                if (materials::softening(law)) {
                    worst_strain = std::max(
                        worst_strain, std::abs(body.points.epsilon_q_plastic[p] - state.epsilon_q));
                }
            }
            EXPECT_LT(worst, 1e-9)
                << materials::traits(law).name << ", set " << static_cast<int>(instructions);
            EXPECT_LT(worst_strain, 1e-12);
        }
    }
}

TEST(Loops, AnswerTheSameForAnyNumberOfThreads) {
    const scene::Scene scene = heap_of(sand(5e6, 0.3, 1e3, 30.0), 0.2);
    Body alone = body_of(scene, {.threads = 1});
    Body together = body_of(scene, {.threads = 3});
    ASSERT_GT(alone.points.size(), 4000U);  // enough for three threads
    step_often(alone, scene, 40);
    step_often(together, scene, 40);
    EXPECT_EQ(alone.points.x, together.points.x);
    EXPECT_EQ(alone.points.syy, together.points.syy);
    EXPECT_EQ(alone.tally.plastic, together.tally.plastic);
    EXPECT_EQ(alone.tally.friction, together.tally.friction);
}

TEST(Loops, NameTheFirstPointThatLeavesTheGrid) {
    const scene::Scene scene = heap_of(sand(5e6, 0.3, 1e3, 30.0), 0.5);
    for (const InstructionSet instructions : sets_of_this_cpu()) {
        Body body = body_of(scene, {.instructions = instructions});
        std::ranges::fill(body.points.vy, 1e6);
        step(body, 1e-3);
        EXPECT_EQ(body.tally.lost, 0U);
    }
}

TEST(Loops, AnswerTheSameOnAnyCpuToRoundOff) {
    scene::Scene scene = heap_of(sand(5e6, 0.3, 1e3, 30.0), 0.5);
    Body plain = body_of(scene, {.instructions = InstructionSet::plain});
    step_often(plain, scene, 60);
    for (const InstructionSet instructions : sets_of_this_cpu()) {
        Body other = body_of(scene, {.instructions = instructions});
        step_often(other, scene, 60);
        for (std::size_t p = 0; p < plain.points.size(); ++p) {
            ASSERT_NEAR(plain.points.x[p], other.points.x[p], 1e-9) << p;
            ASSERT_NEAR(plain.points.y[p], other.points.y[p], 1e-9) << p;
        }
    }
}

TEST(AntiLocking, AutoIsForPlasticAndNearlyIncompressibleSoil) {
    const auto averages = [](const materials::Law& law) {
        scene::Scene scene = heap_of(law, 0.5);
        scene.mpm->anti_locking = scene::AntiLocking::automatic;
        return !body_of(scene, {}).averages.at(0).empty();
    };
    EXPECT_TRUE(averages(sand(5e6, 0.3, 1e3, 30.0)));
    EXPECT_TRUE(averages(elastic(5e6, 0.49)));
    EXPECT_FALSE(averages(elastic(5e6, 0.3)));
}

}  // namespace
}  // namespace breach::mpm::test
