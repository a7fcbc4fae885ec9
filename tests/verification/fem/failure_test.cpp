// The switch from elastic to plastic soil sets a slope in motion: balance of momentum and energy.
#include <functional>

#include "core/exchange/mesh_snapshot.hpp"
#include "tests/verification/fem/begun_element.hpp"

namespace breach::fem::failure_test {
namespace {

using bench::expect_error;
using nlohmann::json;

/// A column of weak soil whose right support is removed.
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
    scene["fem"]["newmark_beta"] = 0.25;  // no numerical damping: energy is conserved
    scene["fem"]["newmark_gamma"] = 0.5;
    bench::Run run(scene);
    const auto& history = run.go().history;
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
    const Course& a = run.go();
    // Newton's second law of the whole body: sum m a = weight + reactions, where the reaction of a
    // held dof is its internal force minus its own load.
    const Model& model = a.model;
    const Unknowns unknowns = model.unknowns(Solved::motion_and_pressure);
    double inertia = 0.0, weight = 0.0, reactions = 0.0;
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const auto d = static_cast<Eigen::Index>(2 * i + 1);
        inertia += model.mass[d] * a.motion.a[d];
        weight += model.external_force[d];
        if (unknowns.of_dof[2 * i + 1] < 0) {
            reactions += a.motion.force[d] - model.external_force[d];
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
        crest[k] = run.go().history.back().crest_displacement;
    }
    std::printf("    crest after 0.5 s: %.5f and %.5f m\n", crest[0], crest[1]);
    // Perfect plasticity and gamma 0.6 (first order): 1 % for a fourfold step.
    expect_error("crest with dt 5 ms against 1.25 ms", std::abs(crest[0] / crest[1] - 1.0), 0.01);
}

TEST(Failure, AnEntangledMeshIsARegularEndWithTheLastGoodState) {
    json scene = unsupported_column();
    scene["fem"]["stages"][1]["duration"] = 1.5;
    scene["fem"]["snapshot_times"] = {0.25, 0.5};
    bench::Run run(scene);
    run.go();
    const double last = run.course().position.time;
    const json& facts = run.session().result();
    ASSERT_EQ(facts.at("ended"), "entangled") << "the column should have entangled its mesh";
    EXPECT_EQ(facts.at("end_time"), last);
    const json& what = facts.at("entanglement");
    std::printf("    %s\n", what.dump().c_str());
    EXPECT_GT(what.at("time"), last) << "the step in which it folded comes after the last good one";
    EXPECT_EQ(what.at("region"), "block");
    EXPECT_GT(what.at("mean_epsilon_q"), 0.1);
    EXPECT_EQ(what.at("kind"), "band") << "a whole column collapses";
    ASSERT_EQ(run.session().flags().size(), 1u);
    EXPECT_EQ(run.session().flags()[0].code, "entangled");
    EXPECT_EQ(run.session().flags()[0].severity, fault::Severity::warning);
    char name[64];
    std::snprintf(name, sizeof name, "snapshot_%.6f.vtkhdf", last);
    for (const std::string& file : {std::string("snapshot_0.250000.vtkhdf"),
                                    std::string("snapshot_0.500000.vtkhdf"), std::string(name)}) {
        EXPECT_NO_THROW(exchange::read_mesh_snapshot(run.folder() / file)) << file;
    }
    EXPECT_TRUE(std::filesystem::exists(run.folder() / "history.h5"));
}

/// An elastic column under sudden gravity, with mass-proportional damping.
TEST(KineticEnergy, OverItsPeakFallsToZeroWithTheMotion) {
    constexpr double H = 10.0, damping = 5.0, duration = 4.0;
    bench::Block block{.height = H, .rows = 20};
    block.stages = json::array({{{"type", "dynamic"},
                                 {"name", "swing"},
                                 {"laws", "elastic"},
                                 {"duration", duration},
                                 {"time_step", 0.002}}});
    json scene = bench::scene_of(block);
    scene["fem"]["rayleigh_mass"] = damping;
    scene["fem"]["telemetry_interval"] = 0;
    bench::Run run(scene);
    const std::vector<Reading>& history = run.go().history;
    double peak = 0.0, wrong = 0.0;
    for (const Reading& each : history) {
        peak = std::max(peak, each.kinetic_energy);
        wrong =
            std::max(wrong, std::abs(each.kinetic_energy - each.kinetic_energy_over_peak * peak));
    }
    expect_error("kinetic energy less its share of the peak so far", wrong / peak, 1e-12);
    // The first mode decays with exp(-damping t / 2), its energy with the square of it.
    expect_error("energy over its peak at the end", history.back().kinetic_energy_over_peak,
                 std::exp(-damping * (duration - 0.2)));
    EXPECT_GT(history.back().kinetic_energy_over_peak, 0.0);
    const json& told = run.session().result().at("milestones").at("kinetic_energy_peak");
    const double quarter = H / mechanics::Elasticity{20e6, 0.3}.wave_speed(2000.0);
    std::printf("    peak at %.3f s, a quarter of the period is %.3f s\n",
                told.at("time").get<double>(), quarter);
    EXPECT_LT(told.at("time"), 1.1 * quarter) << "on its way down for the first time";
}

TEST(Failure, AMeshThatFoldsInItsFirstStepIsAFaultOfTheScene) {
    json scene = unsupported_column();
    scene["fem"]["least_jacobian_ratio"] = 0.999999;  // any strain is beyond the limit
    bench::Run run(scene);
    try {
        run.go();
        FAIL() << "nothing had moved, so nothing had failed";
    } catch (const fault::Breakdown& breakdown) {
        const std::string what = breakdown.what();
        EXPECT_NE(what.find("first step"), std::string::npos) << what;
        EXPECT_NE(what.find("of 'block' at ("), std::string::npos) << what;
    }
}

/// Strain of the elements of a 10 x 10 block; the diagnosis when element 55 folds.
Entanglement judged(const std::function<double(std::size_t)>& epsilon_q) {
    bench::Block block{.width = 10.0, .height = 10.0, .columns = 10, .rows = 10};
    const scene::Scene scene = bench::parse(bench::scene_of(block));
    const Model model = bench::model_of(scene);
    const Watch watch(scene::fem_of(scene), model);
    Motion motion = at_rest(model);
    for (std::size_t p = 0; p < motion.strain.size(); ++p) {
        const double gamma = std::sqrt(3.0) * epsilon_q(p / model.points_per_element);
        motion.strain[p] = Voigt(0.0, 0.0, 0.0, gamma);  // pure shear: epsilon_q = gamma / sqrt(3)
    }
    Distortion folded;
    folded.least = 0.0;
    folded.worst_element = 55;
    return entanglement_of(scene.section, model, watch, motion, folded, 6.7);
}

TEST(Entangled, OneCornerInSoundSoilIsNoFailureOfTheDam) {
    const Entanglement what = judged([](std::size_t e) { return e == 55 ? 0.9 : 0.08; });
    EXPECT_EQ(what.kind, Entanglement::Kind::corner);
    EXPECT_NEAR(what.mean_epsilon_q, 0.08, 1e-12) << "its own strain does not count";
    EXPECT_EQ(flag_of(what).code, "entangled_corner");
    EXPECT_EQ(flag_of(what).severity, fault::Severity::questionable);
    const std::string words = in_words(what);
    for (const char* part : {"one corner at (", "6.7 s", "8 %", "no failure surface",
                             "not a failure of the dam", "refine"}) {
        EXPECT_NE(words.find(part), std::string::npos) << part << " in " << words;
    }
}

TEST(Entangled, InSoilThatHasFailedItIsTheEndOfTheFailure) {
    const Entanglement what = judged([](std::size_t) { return 0.3; });
    EXPECT_EQ(what.kind, Entanglement::Kind::band);
    EXPECT_EQ(flag_of(what).code, "entangled");
}

TEST(Entangled, OnAThinBandFromGroundToGroundItIsTheEndOfTheFailure) {
    // A trough of strained elements: down from the top at column 1, along row 5, up at column 8.
    // Its neighbours are unstrained, so that their mean is small.
    const Entanglement what = judged([](std::size_t e) {
        const std::size_t column = e % 10, row = e / 10;
        const bool leg = row >= 5 && (column == 1 || column == 8);
        return leg || (row == 5 && column >= 1 && column <= 8) ? 0.2 : 0.01;
    });
    EXPECT_LT(what.mean_epsilon_q, 0.1);
    EXPECT_EQ(what.failure_surfaces, 1u);
    EXPECT_EQ(what.kind, Entanglement::Kind::band);
}

TEST(Entangled, IsReadBackAsItWasWritten) {
    const Entanglement what = judged([](std::size_t) { return 0.3; });
    const scene::Scene scene = bench::parse(bench::scene_of({}));
    EXPECT_EQ(as_json(entanglement_from(as_json(what), scene.section)), as_json(what));
    EXPECT_EQ(entanglement_from(as_json(what), scene.section).region, 0u);
}

TEST(Slip, IsThatOfTheBodyCutOffAgainstTheRest) {
    bench::Block block{.width = 20.0, .height = 10.0, .columns = 20, .rows = 10};
    json scene = bench::scene_of(block);
    scene["fem"]["failure_surfaces"]["separation"] = 3;
    const scene::Scene parsed = bench::parse(scene);
    const Model model = bench::model_of(parsed);
    const Watch watch(scene::fem_of(parsed), model);
    Motion motion = at_rest(model);
    // A trough from column 5 to column 14, four rows deep; the soil in it moves by 0.3, -0.4 m.
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        const std::size_t column = e % 20, row = e / 20;
        const bool within = column >= 5 && column <= 14 && row >= 6;
        const bool wall = within && (column == 5 || column == 14 || row == 6);
        for (std::size_t g = 0; wall && g < model.points_per_element; ++g) {
            motion.strain[e * model.points_per_element + g] = Voigt(0.0, 0.0, 0.0, 0.5);
        }
        if (!within || wall) continue;
        for (const std::int32_t node : model.mesh.quads[e]) {
            motion.u.segment<2>(2 * static_cast<Eigen::Index>(node)) = Vec2(0.3, -0.4);
        }
    }
    Reading reading;
    watch.read(model, motion, {}, reading);
    EXPECT_EQ(reading.failure_surfaces, 1.0);
    EXPECT_NEAR(reading.slip_across_band, 0.5, 1e-12);
}

TEST(Refusal, SaysWhetherTheStrainLimitOrTheEvaluationsWereHit) {
    bench::Block block{.columns = 2};
    block.law = {{"type", "pm4sand"}, {"D_R", 0.35}, {"G_0", 476}, {"h_po", 2.7}};
    const Model model = bench::model_of(bench::parse(bench::scene_of(block)));
    Motion motion = at_rest(model);
    for (State& point : motion.points) point.sigma = Voigt(-25e3, -50e3, -25e3, 0.0);
    begin_memory(model, motion);
    auto law = std::get<materials::PM4Sand>(model.zones[0].law);
    MemoryPass pass(model);
    Motion trial = motion;
    std::vector<Voigt> d_epsilon(model.points(), Voigt::Zero());
    d_epsilon[5] = Voigt(0.0, 0.0, 0.0, 0.06);
    ASSERT_EQ(pass.integrate(law, 0, d_epsilon, motion, trial), MemoryPass::Answer::refused);
    EXPECT_EQ(pass.refusal().element, 1u) << "four points in each";
    EXPECT_NE(in_words(pass.refusal()).find("beyond the limit of 0.05"), std::string::npos);
    law.options.most_evaluations = 1;
    d_epsilon[5] = Voigt(0.0, 0.0, 0.0, 0.04);
    ASSERT_EQ(pass.integrate(law, 0, d_epsilon, motion, trial), MemoryPass::Answer::refused);
    EXPECT_EQ(pass.refusal().element, 1u);
    EXPECT_NE(in_words(pass.refusal()).find("evaluations were used up"), std::string::npos);
}

TEST(Crest, FarFromEveryNodeIsSaid) {
    bench::Block block{.width = 10.0, .height = 10.0, .columns = 10, .rows = 10};
    json scene = bench::scene_of(block);
    bench::Run near(scene);
    EXPECT_TRUE(near.session().flags().empty());
    EXPECT_EQ(near.session().result().at("crest").at("distance"), 0.0);
    scene["fem"]["crest"] = {510.0, 10.0};
    bench::Run far(scene);
    ASSERT_EQ(far.session().flags().size(), 1u);
    EXPECT_EQ(far.session().flags()[0].code, "far_crest");
    EXPECT_EQ(far.session().result().at("crest").at("distance"), 500.0);
}

/// A vertical cut of 5 m in soft clay, `width` behind it.
json cut_in_clay(double width, double c_kPa) {
    bench::Block block{.width = width, .height = 5.0};
    block.law = {{"type", "mohr_coulomb"}, {"E_MPa", 20},  {"nu", 0.3},
                 {"c_kPa", c_kPa},         {"phi_deg", 0}, {"tension_cutoff_kPa", 100}};
    block.columns = static_cast<int>(width);
    block.rows = 5;
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "failure"}, {"duration", 2.0}, {"time_step", 0.01}});
    json scene = bench::scene_of(block);
    scene["section"]["regions"].push_back(
        {{"name", "foot"},
         {"material", "soil"},
         {"polygon", {{0, -2}, {width + 6, -2}, {width + 6, 0}, {width, 0}, {0, 0}, {0, -2}}},
         {"mesh",
          {{"type", "block"},
           {"divisions", {block.columns + 6, 2}},
           {"corners", {{0, -2}, {width + 6, -2}, {width + 6, 0}, {0, 0}}}}}});
    scene["fem"]["supports"] = {
        {{"name", "left"}, {"from", {0, -2}}, {"to", {0, 5}}, {"fixes", "x"}},
        {{"name", "right"}, {"from", {width + 6, -2}}, {"to", {width + 6, 0}}, {"fixes", "x"}},
        {{"name", "base"}, {"from", {0, -2}}, {"to", {width + 6, -2}}, {"fixes", "xy"}}};
    return scene;
}

std::string upstream_wall_of(double width, double c_kPa) {
    bench::Run run(cut_in_clay(width, c_kPa));
    run.go();
    for (const fault::Flag& each : run.session().flags())
        if (each.code == "upstream_wall") {
            EXPECT_EQ(each.severity, fault::Severity::questionable);
            std::printf("    %s\n", each.message.c_str());
            return each.message;
        }
    return "";
}

TEST(UpstreamWall, IsFlaggedWhereTheFailingMassComesNear) {
    EXPECT_NE(upstream_wall_of(8.0, 5.0).find("at least"), std::string::npos);
    EXPECT_EQ(upstream_wall_of(40.0, 5.0), "") << "far behind the failure";
    EXPECT_EQ(upstream_wall_of(8.0, 100.0), "") << "nothing fails";
}

}  // namespace
}  // namespace breach::fem::failure_test
