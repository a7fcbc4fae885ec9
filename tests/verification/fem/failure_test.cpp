// The switch from elastic to plastic soil sets a slope in motion: momentum and energy must account
// for it.
#include "core/exchange/mesh_snapshot.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem {
namespace {

using bench::expect_error;
using nlohmann::json;

/// A column of weak soil whose right side has been taken away.
json unsupported_column() {
    bench::Block block{.width = 10.0, .height = 20.0, .columns = 10, .rows = 20};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 1}, {"phi_deg", 30}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "failure"}, {"duration", 0.5}, {"time_step", 0.005}});
    json scene = bench::scene_of(block);
    scene["fem"]["supports"].erase(1);
    scene["fem"]["telemetry_interval"] = 0;
    return scene;
}

TEST(Failure, EnergyIsAccountedFor) {
    json scene = unsupported_column();
    scene["fem"]["newmark_beta"] = 0.25;  // no numerical damping: nothing may be lost
    scene["fem"]["newmark_gamma"] = 0.5;
    bench::Run run(scene);
    const auto& history = run.go().history();
    double worst = 0.0, largest = 0.0;
    for (const Reading& r : history) {
        largest = std::max(largest, r.kinetic_energy);
        worst = std::max(worst, std::abs(r.kinetic_energy + r.internal_work - r.external_work));
    }
    std::printf("    kinetic %.0f, internal %.0f, external %.0f J at the end\n",
                history.back().kinetic_energy, history.back().internal_work,
                history.back().external_work);
    // The average-acceleration rule balances kinetic energy with the trapezoidal work of the forces
    // identically, up to the out-of-balance force that Newton leaves (1e-6 of the weight).
    expect_error("energy error over the largest kinetic energy", worst / largest, 1e-4);
}

TEST(Failure, VerticalMomentumFollowsWeightAndReactions) {
    bench::Run run(unsupported_column());
    const Analysis& a = run.go();
    // Newton's second law of the whole body: sum m a = weight + reactions, where the reaction of a
    // held dof is its internal force minus its own load.
    const Model& model = a.model();
    const Unknowns unknowns = model.unknowns(Solved::motion_and_pressure);
    double inertia = 0.0, weight = 0.0, reactions = 0.0;
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i + 1);
        inertia += model.mass[d] * a.motion().a[d];
        weight += model.external_force[d];
        if (unknowns.of_dof[2 * i + 1] < 0) {
            reactions += a.motion().force[d] - model.external_force[d];
        }
    }
    expect_error("sum of m a against weight and reactions",
                 std::abs(inertia - weight - reactions) / std::abs(weight), 1e-5);
    EXPECT_LT(inertia, 0.0) << "the column falls";
}

TEST(Failure, StressesAreInsideTheYieldSurfaceFromTheFirstInstant) {
    json scene = unsupported_column();
    scene["fem"]["snapshot_times"] = {0.0};
    bench::Run run(scene);
    run.go();
    const auto file = exchange::read_mesh_snapshot(run.folder() / "snapshot_0.000000.vtkhdf");
    const auto& law = std::get<materials::MohrCoulomb>(run.session().scene().materials[0].law);
    double excess = 0.0;
    for (std::size_t p = 0; p < file.snapshot.stress.size(); ++p) {
        State point;
        point.sigma = file.snapshot.stress[p];
        point.epsilon_q = file.snapshot.epsilon_q_plastic[p];
        excess = std::max(excess, materials::yield_excess(law, point));
    }
    expect_error("stress outside the yield surface at t = 0 over 20 m of weight", excess / 353e3,
                 1e-9);
    double moving = 0.0;
    for (const auto& a : file.snapshot.acceleration) moving = std::max(moving, a.norm());
    EXPECT_GT(moving, 0.1) << "the unbalanced force must set the soil in motion";
}

TEST(Failure, ScarcelyDependsOnTheTimeStep) {
    double crest[2];
    for (int k = 0; k < 2; ++k) {
        json scene = unsupported_column();
        scene["fem"]["stages"][1]["time_step"] = k == 0 ? 0.005 : 0.00125;
        bench::Run run(scene);
        crest[k] = run.go().history().back().crest_displacement;
    }
    std::printf("    crest after 0.5 s: %.5f and %.5f m\n", crest[0], crest[1]);
    // Perfect plasticity and gamma 0.6 (first order): a per cent for a fourfold step.
    expect_error("crest with dt 5 ms against 1.25 ms", std::abs(crest[0] / crest[1] - 1.0), 0.01);
}

TEST(Failure, AnEntangledMeshEndsTheRunWithTheLastGoodState) {
    json scene = unsupported_column();
    scene["fem"]["stages"][1]["duration"] = 1.5;
    scene["fem"]["snapshot_times"] = {0.25, 0.5};
    bench::Run run(scene);
    try {
        run.go();
        FAIL() << "the column should have entangled its mesh";
    } catch (const fault::Breakdown& breakdown) {
        std::printf("    %s\n", breakdown.what());
        EXPECT_NE(std::string(breakdown.what()).find("element"), std::string::npos);
    }
    const double last = run.analysis().position().time;
    char name[64];
    std::snprintf(name, sizeof name, "snapshot_%.6f.vtkhdf", last);
    for (const std::string& file : {std::string("snapshot_0.250000.vtkhdf"),
                                    std::string("snapshot_0.500000.vtkhdf"), std::string(name)}) {
        EXPECT_NO_THROW(exchange::read_mesh_snapshot(run.folder() / file)) << file;
    }
    EXPECT_TRUE(std::filesystem::exists(run.folder() / "checkpoint.h5"));
    EXPECT_TRUE(std::filesystem::exists(run.folder() / "history.h5"));
}

}  // namespace
}  // namespace breach::fem
