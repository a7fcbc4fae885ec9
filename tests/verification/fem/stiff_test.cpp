// Stiff and extreme cases: the right result or a clear stop.
#include <cmath>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::stiff_test {
namespace {

using bench::expect_error;
using nlohmann::json;

json dynamic_stage(double duration, double time_step) {
    return {
        {"type", "dynamic"}, {"name", "wait"}, {"duration", duration}, {"time_step", time_step}};
}

double settlement_error(const Course& a, double H, double M) {
    const double exact = -2000.0 * 9.81 * H * H / (2.0 * M);
    const auto top = static_cast<Eigen::Index>(2 * nearest_node(a.model.mesh, {0.0, H}) + 1);
    return std::abs(a.motion.u[top] / exact - 1.0);
}

TEST(Extreme, PoissonsRatioOf04999GivesTheExactColumn) {
    bench::Block block{.width = 4.0, .height = 20.0, .columns = 4, .rows = 20};
    block.law["nu"] = 0.4999;
    bench::Run run(bench::scene_of(block));
    const double M = mechanics::Elasticity{20e6, 0.4999}.constrained_modulus();
    expect_error("settlement at nu 0.4999", settlement_error(run.go(), 20.0, M), 1e-8);
}

TEST(Extreme, AspectRatioOfAHundredGivesTheExactColumn) {
    bench::Run run(bench::scene_of({.width = 100.0, .height = 10.0, .columns = 5, .rows = 50}));
    const double M = mechanics::Elasticity{20e6, 0.3}.constrained_modulus();
    const Quality quality = quality_of(run.course().model.mesh);
    EXPECT_NEAR(quality.largest_aspect, 100.0, 1e-6);
    expect_error("settlement at aspect ratio 1:100", settlement_error(run.go(), 10.0, M), 1e-9);
}

TEST(Extreme, StiffnessContrastOfAMillionGivesTheExactColumn) {
    json scene = bench::scene_of({.width = 4.0, .height = 5.0, .columns = 4, .rows = 5});
    scene["materials"]["rock"] = scene["materials"]["soil"];
    scene["materials"]["soil"]["law"]["E_MPa"] = 1;
    scene["materials"]["rock"]["law"]["E_MPa"] = 1e6;
    scene["section"]["regions"].push_back({{"name", "rock"},
                                           {"material", "rock"},
                                           {"polygon", {{0, -5}, {4, -5}, {4, 0}, {0, 0}, {0, -5}}},
                                           {"mesh", {{"type", "block"}, {"divisions", {4, 5}}}}});
    for (int k = 0; k < 2; ++k) scene["fem"]["supports"][k]["from"][1] = -5;
    scene["fem"]["supports"][2]["from"][1] = scene["fem"]["supports"][2]["to"][1] = -5;
    bench::Run run(scene);
    const double M = mechanics::Elasticity{1e6, 0.3}.constrained_modulus();
    // The rock's 5 m shorten by 3e-6 of the soil's settlement.
    expect_error("settlement on rock a million times stiffer", settlement_error(run.go(), 5.0, M),
                 5e-6);
}

TEST(Extreme, ATimeStepAHundredTimesTooLargeStaysBounded) {
    // Elastic column under sudden gravity: dt = 100 times the wave's travel time through an
    // element. Newmark with gamma 0.6 damps what it cannot resolve, so that the column ends in
    // static settlement.
    const double h = 0.5, c = mechanics::Elasticity{20e6, 0.3}.wave_speed(2000.0);
    bench::Block block{.width = 1.0, .height = 10.0, .columns = 1, .rows = 20};
    block.stages = json::array({dynamic_stage(400.0 * 100.0 * h / c, 100.0 * h / c)});
    block.stages[0]["laws"] = "elastic";
    json scene = bench::scene_of(block);
    bench::Run run(scene);
    const double M = mechanics::Elasticity{20e6, 0.3}.constrained_modulus();
    expect_error("settlement after 400 huge steps", settlement_error(run.go(), 10.0, M), 1e-3);
}

TEST(Extreme, ASlidingSlopeWithHugeStepsCutsThemOrStopsClearly) {
    bench::Block block{.width = 10.0, .height = 20.0, .columns = 10, .rows = 20};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 1}, {"phi_deg", 30}};
    block.stages.push_back(dynamic_stage(0.5, 0.5));  // 100 times the scene's step
    json scene = bench::scene_of(block);
    scene["fem"]["supports"].erase(1);
    bench::Run run(scene);
    try {
        run.go();
        std::printf("    reached the end with %lld cut steps\n",
                    static_cast<long long>(run.course().position.cut_steps));
    } catch (const fault::Breakdown& breakdown) {
        std::printf("    %s\n", breakdown.what());
    }
    EXPECT_TRUE(run.course().motion.u.allFinite());
    EXPECT_LT(run.course().motion.u.lpNorm<Eigen::Infinity>(), 5.0);
}

TEST(Extreme, NothingDriftsInALongRest) {
    bench::Block block{.width = 10.0, .height = 10.0, .columns = 5, .rows = 5, .gravity = 0.0};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 1}, {"phi_deg", 30}};
    block.stages.push_back(dynamic_stage(100.0, 0.1));
    bench::Run run(bench::scene_of(block));
    const Course& a = run.go();
    expect_error("displacement after 100 s without gravity [m]", a.motion.u.norm(), 0.0);
    block.gravity = 9.81;
    block.law["phi_deg"] = 35;
    bench::Run heavy(bench::scene_of(block));
    // Newton may leave 1e-6 of the weight unbalanced, which is 1e-6 of the settlement of 4 cm.
    expect_error("displacement after 100 s in equilibrium [m]",
                 heavy.go().motion.u.lpNorm<Eigen::Infinity>(), 4e-8);
}

TEST(Extreme, AHeapThatCannotStandUnderStaticPlasticityStopsClearly) {
    bench::Block block{.width = 10.0, .height = 20.0, .columns = 5, .rows = 10};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 1}, {"phi_deg", 20}};
    block.stages = json::array({{{"type", "static"}, {"name", "gravity"}, {"laws", "scene"}}});
    json scene = bench::scene_of(block);
    scene["fem"]["supports"].erase(1);
    bench::Run run(scene);
    try {
        run.go();
        FAIL() << "a 20 m wall of sand has no equilibrium";
    } catch (const fault::Breakdown& breakdown) {
        std::printf("    %s\n", breakdown.what());
        EXPECT_NE(std::string(breakdown.what()).find("no equilibrium"), std::string::npos);
    }
}

}  // namespace
}  // namespace breach::fem::stiff_test
