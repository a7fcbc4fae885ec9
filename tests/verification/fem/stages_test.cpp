// Stages that change the body, against closed forms of an elastic column: lift, excavation,
// surcharge, removal of a support; and refused stages.
#include <cmath>

#include "core/exchange/excess_pressure.hpp"
#include "fem_solver/checkpoint.hpp"
#include "fem_solver/monitors/monitors.hpp"
#include "fem_solver/snapshot.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::stages_test {
namespace {

using bench::expect_error;
using bench::place_refused;
using bench::static_stage;
using bench::u_at;
using nlohmann::json;

constexpr double E = 20e6, nu = 0.3, rho = 2000.0, g = 9.81;
constexpr double M = E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));  // one-dimensional [Pa]

/// A column 1 m wide of two regions, "low" 4 m and "top" 2 m high, between smooth walls.
json column(const json& stages) {
    json scene = bench::scene_of({.height = 4.0, .rows = 4, .stages = stages});
    json& regions = scene["section"]["regions"];
    regions[0]["name"] = "low";
    json top = regions[0];
    top["name"] = "top";
    top["polygon"] = {{0, 4}, {1, 4}, {1, 6}, {0, 6}, {0, 4}};
    top["mesh"]["divisions"] = {1, 2};
    regions.push_back(top);
    scene["fem"]["supports"][0]["to"] = {0, 6};
    scene["fem"]["supports"][1]["to"] = {1, 6};
    scene["fem"]["crest"] = {1, 4};
    return scene;
}

TEST(Stages, ALiftOnAnElasticColumnSettlesItAsTheClosedFormSays) {
    for (const std::string kind : {"ssp", "bbar"}) {
        json before =
            column({static_stage("gravity"), static_stage("lift", {{"activate", {"top"}}})});
        before["fem"]["element"] = kind;
        bench::Run run(before);
        const Course& done = run.go();
        // Its own weight, rho g H^2 / 2 M, then 2 m of soil on 4 m.
        const double own = rho * g * 16.0 / (2.0 * M), lift = rho * g * 2.0 * 4.0 / M;
        expect_error(kind + ": settlement of the ground under a lift",
                     std::abs(-u_at(done, {1, 4}).y() / (own + lift) - 1.0), 1e-8);
        // The lift is placed without stress: its top settles with the ground and under its own
        // weight.
        const double of_lift = rho * g * 4.0 / (2.0 * M);
        expect_error(kind + ": settlement of the lift's top",
                     std::abs(-u_at(done, {1, 6}).y() / (lift + of_lift) - 1.0), 1e-8);
    }
}

TEST(Stages, ALiftThatClosesAGapRestsOnBothSidesAndTheBase) {
    json scene = column({static_stage("gravity"), static_stage("fill", {{"activate", {"gap"}}})});
    json& regions = scene["section"]["regions"];
    const json one = regions[0];
    regions = json::array();
    for (const auto& [name, x] : {std::pair{"left", 0.0}, {"gap", 1.0}, {"right", 2.0}}) {
        regions.push_back(one);
        regions.back()["name"] = name;
        regions.back()["polygon"] = {{x, 0}, {x + 1, 0}, {x + 1, 4}, {x, 4}, {x, 0}};
        regions.back()["mesh"]["divisions"] = {2, 4};
    }
    scene["fem"]["supports"] = {
        {{"name", "base"}, {"from", {0, 0}}, {"to", {3, 0}}, {"fixes", "xy"}}};
    bench::Run run(scene);
    const Course& done = run.go();
    const auto force_of = [&](std::size_t node) {
        return done.motion.force.segment<2>(static_cast<Eigen::Index>(2 * node));
    };
    // The base's nodes carry their share of the weight, which is no force of the soil.
    Vec2 borne = Vec2::Zero();
    for (std::size_t i = 0; i < done.model.mesh.nodes.size(); ++i) {
        if (done.model.mesh.nodes[i].y() == 0.0) continue;
        borne += force_of(i);
    }
    const double above = 3.0 * rho * g * (4.0 - 0.5);
    expect_error("what all nodes above the base bear, over their weight",
                 (borne - Vec2(0.0, -above)).norm() / above, 1e-8);
    expect_error("left and right settle alike",
                 std::abs(u_at(done, {0.5, 4}).y() / u_at(done, {2.5, 4}).y() - 1.0), 1e-8);
    // Before, both columns leaned into the gap; the soil filling it settles less than a separate
    // column.
    const double alone = rho * g * 16.0 / (2.0 * M);
    EXPECT_GT(-u_at(done, {1.5, 4}).y(), 0.2 * alone);
    EXPECT_LT(-u_at(done, {1.5, 4}).y(), 1.5 * alone);
}

TEST(Stages, AnExcavationHeavesTheGroundAsTheClosedFormSays) {
    for (const int steps : {1, 4}) {
        bench::Run run(column({static_stage("gravity"),
                               static_stage("dig", {{"remove", {"top"}}, {"load_steps", steps}})}));
        const Course& done = run.go();
        const double left = rho * g * 16.0 / (2.0 * M);  // of the 4 m that are there alone
        expect_error("settlement that an excavation leaves",
                     std::abs(-u_at(done, {1, 4}).y() / left - 1.0), 1e-8);
        const State& lowest = done.motion.points.at(0);
        EXPECT_LT(lowest.sigma[1], 0.0);
        for (std::size_t e = 0; e < done.model.mesh.quads.size(); ++e) {
            if (!done.model.is_absent(e)) continue;
            EXPECT_EQ(done.motion.points.at(e * done.model.points_per_element).sigma.norm(), 0.0);
        }
    }
}

TEST(Stages, ASurchargeCompressesTheColumnAndGoesAgain) {
    const json load = json::array({{{"from", -1}, {"to", 2}, {"pressure_kPa", 50}}});
    bench::Run loaded(
        column({static_stage("gravity"), static_stage("load", {{"surcharge", load}})}));
    const double own = rho * g * 36.0 / (2.0 * M);
    expect_error("settlement under a surcharge",
                 std::abs(-u_at(loaded.go(), {1, 6}).y() / (own + 50e3 * 6.0 / M) - 1.0), 1e-8);
    bench::Run unloaded(
        column({static_stage("gravity"), static_stage("load", {{"surcharge", load}}),
                static_stage("unload", {{"surcharge", json::array()}})}));
    expect_error("settlement after it has gone",
                 std::abs(-u_at(unloaded.go(), {1, 6}).y() / own - 1.0), 1e-8);
}

TEST(Stages, ARemovedSupportGivesItsReactionBack) {
    // Without gravity: a load on top, smooth walls; then the right wall is removed.
    json scene = column(
        {static_stage("load", {{"surcharge", {{{"from", -1}, {"to", 2}, {"pressure_kPa", 50}}}}}),
         static_stage("release", {{"release", {"right"}}, {"load_steps", 2}})});
    scene["gravity"] = 0.0;
    scene["fem"]["supports"][2]["fixes"] = "y";
    bench::Run run(scene);
    const Course& done = run.go();
    // sigma_xx = 0 in plane strain: epsilon_yy = -(1 - nu^2) q / E, epsilon_xx = nu (1 + nu) q / E.
    expect_error("settlement without the wall",
                 std::abs(-u_at(done, {1, 6}).y() / ((1 - nu * nu) * 50e3 * 6.0 / E) - 1.0), 1e-8);
    expect_error("widening without the wall",
                 std::abs(u_at(done, {1, 6}).x() / (nu * (1 + nu) * 50e3 / E) - 1.0), 1e-8);
}

/// The column with water up to `level`; of NorSand or elastic.
json column_with_water(const json& stages, double level) {
    json scene = column(stages);
    scene["fem"]["water"] = {{"line", {{0, level}}}};
    scene["materials"]["soil"]["void_ratio"] = 0.8;
    scene["materials"]["soil"]["permeability"] = {1e-6, 1e-6};
    return scene;
}

json line_at(double level) { return {{"phreatic_line", {{0, level}}}}; }

TEST(Stages, ARisingPhreaticLineHeavesTheGroundAsTheClosedFormSays) {
    constexpr double of_water = 1000.0 * g;
    const double own = rho * g * 36.0 / (2.0 * M);
    const auto heave = [&](double level) { return of_water * level * level / (2.0 * M); };
    for (const std::string kind : {"ssp", "bbar"}) {
        json rise = line_at(5);
        rise["load_steps"] = 4;
        json scene = column_with_water({static_stage("gravity"), static_stage("rise", rise)}, 1.0);
        scene["fem"]["element"] = kind;
        bench::Run run(scene);
        expect_error(kind + ": settlement after a phreatic rise",
                     std::abs(-u_at(run.go(), {1, 6}).y() / (own - heave(5)) - 1.0), 1e-8);
        scene["fem"]["stages"].push_back(static_stage("fall", line_at(2)));
        bench::Run fallen(scene);
        expect_error(kind + ": settlement after it fell",
                     std::abs(-u_at(fallen.go(), {1, 6}).y() / (own - heave(2)) - 1.0), 1e-8);
    }
    // A pond of 3 m loads the soil with its weight: the effective stress is that with water at the
    // ground.
    bench::Run pond(
        column_with_water({static_stage("gravity"), static_stage("pond", line_at(9))}, 1.0));
    const Course& under = pond.go();
    expect_error("settlement of the ground below a pond",
                 std::abs(-u_at(under, {1, 6}).y() / (own - heave(6)) - 1.0), 1e-8);
    expect_error("pore pressure at the base below a pond",
                 std::abs(under.motion.p[0] / (of_water * 9.0) - 1.0), 1e-12);
}

// Pore pressure stays hydrostatic: soil placed or excavated below water counts with its buoyant
// weight.
TEST(Stages, SoilPlacedOrDugBelowWaterCountsByItsBuoyantWeight) {
    constexpr double rho_w = 1000.0, of_soil = (rho - rho_w) * g;
    const double own = of_soil * 16.0 / (2.0 * M);  // of the lower 4 m
    const json lift = static_stage("lift", {{"activate", {"top"}}, {"load_steps", 3}});
    const json dig = static_stage("dig", {{"remove", {"top"}}, {"load_steps", 3}});
    for (const std::string kind : {"ssp", "bbar"}) {
        const auto column_of = [&](const json& stage, double level) {
            json scene = column_with_water({static_stage("gravity"), stage}, level);
            scene["fem"]["element"] = kind;
            return scene;
        };
        for (const double level : {5.0, 7.0}) {
            bench::Run run(column_of(lift, level));
            const Course& done = run.go();
            const std::string where = kind + ", water at " + std::to_string(level).substr(0, 1);
            const double below = std::min(level, 6.0) - 4.0;  // of the lift
            const double load = (rho * 2.0 - rho_w * below) * g;
            expect_error(where + ": settlement of the ground under a wet lift",
                         std::abs(-u_at(done, {1, 4}).y() / (own + load * 4.0 / M) - 1.0), 1e-8);
            // The lowest row of the lift.
            const double expected = load - 0.5 * of_soil;
            const std::size_t points = done.model.points_per_element;
            double mean = 0.0;
            for (std::size_t p = 4 * points; p < 5 * points; ++p)
                mean -= done.motion.points.at(p).sigma[1] / static_cast<double>(points);
            expect_error(where + ": effective stress in it", std::abs(mean / expected - 1.0), 1e-8);
            expect_error(where + ": pore pressure at the base",
                         std::abs(done.motion.p[0] / (rho_w * g * level) - 1.0), 1e-12);
        }
        // The water stays as it is: below 4 m it fills the pit.
        for (const double level : {5.0, 7.0}) {
            bench::Run dug(column_of(dig, level));
            const Course& done = dug.go();
            const std::string where = kind + ", water at " + std::to_string(level).substr(0, 1);
            expect_error(where + ": settlement that an excavation below water leaves",
                         std::abs(-u_at(done, {1, 4}).y() / own - 1.0), 1e-8);
            const std::size_t ground = nearest_node(done.model.mesh, {1, 4});
            expect_error(where + ": pore pressure on the new ground",
                         std::abs(done.motion.p[static_cast<Eigen::Index>(ground)] /
                                      (rho_w * g * (level - 4.0)) -
                                  1.0),
                         1e-12);
        }
    }
}

TEST(Stages, SoilThatIsGoneCountsInNoShareOfSoftenedSoil) {
    json scene = column({static_stage("gravity"), static_stage("dig", {{"remove", {"top"}}})});
    scene["materials"]["soil"]["law"] = {{"type", "mohr_coulomb"},
                                         {"E_MPa", 20},
                                         {"nu", 0.3},
                                         {"c_kPa", 50},
                                         {"phi_deg", 30},
                                         {"softening",
                                          {{"epsilon_q_start", 0.01},
                                           {"epsilon_q_end", 0.1},
                                           {"c_residual_kPa", 5},
                                           {"phi_residual_deg", 20}}}};
    bench::Run run(scene);
    const Course& done = run.go();
    Motion motion = done.motion;
    for (std::size_t p = 0; p < motion.points.size(); ++p)
        if (!done.model.is_absent(p / done.model.points_per_element))
            motion.points[p].epsilon_q = 0.05;
    const Reading reading =
        read_monitors(done.model, motion, distortion_of(done.model, motion, 0.1), 0, 0.1);
    EXPECT_NEAR(reading.softened_share, 1.0, 1e-12);
}

/// A bank 4 m wide and high beside an excavated pit; elements of 1 m: 16 of the base, 16 of the
/// bank, 16 of the pit. All below water.
class BesideAPit : public testing::Test {
  protected:
    static json scene() {
        json scene = column_with_water(
            {static_stage("gravity"), static_stage("dig", {{"remove", {"pit"}}})}, 6.0);
        scene["fem"]["element"] = "ssp";
        scene["fem"]["failure_surfaces"]["separation"] = 2;
        json& regions = scene["section"]["regions"];
        regions.push_back(regions[0]);
        const auto lay = [&](std::size_t i, const char* name, int left, int right, int low,
                             int high) {
            regions[i]["name"] = name;
            regions[i]["polygon"] = {
                {left, low}, {right, low}, {right, high}, {left, high}, {left, low}};
            regions[i]["mesh"]["divisions"] = {right - left, high - low};
        };
        lay(0, "base", 0, 8, 0, 2);
        lay(1, "bank", 0, 4, 2, 6);
        lay(2, "pit", 4, 8, 2, 6);
        json& supports = scene["fem"]["supports"];
        supports[1]["from"] = {8, 0};
        supports[1]["to"] = {8, 2};
        supports[2]["to"] = {8, 0};
        return scene;
    }

    static std::size_t bank(std::size_t column, std::size_t row) { return 16 + 4 * row + column; }

    bench::Run run_{scene()};
    const Course& done_ = run_.go();
    const Model& model_ = done_.model;
    const Watch watch_{scene::fem_of(run_.session().scene()), model_};
};

TEST_F(BesideAPit, WhatIsGoneHasNoPartInTheStressBeforeTheMotion) {
    const Beginning beginning = beginning_of(model_, done_.motion);
    const auto sigma_v = [&](std::size_t e) { return -done_.motion.points.at(e).sigma[1]; };
    const auto at = [&](const Vec2& x) {
        return beginning.sigma_v0.at(nearest_node(model_.mesh, x));
    };
    const double of_bank = 0.5 * (sigma_v(bank(3, 1)) + sigma_v(bank(3, 2)));
    EXPECT_NEAR(at({4, 4}), of_bank, 1e-9 * of_bank) << "half of it before";
    EXPECT_EQ(at({8, 4}), 0.0);
}

TEST_F(BesideAPit, TheExcessPressureIsThatOfASnapshotsReader) {
    const Beginning beginning = beginning_of(model_, done_.motion);
    Motion motion = done_.motion;
    for (Eigen::Index i = 0; i < motion.p.size(); ++i)
        motion.p[i] += 1e3 * static_cast<double>(i % 7);
    const auto snapshot =
        snapshot_of(run_.session().scene(), model_, motion, beginning, {}, 0.0, 0);
    EXPECT_EQ(watch_.excess_pressure(model_, motion, beginning),
              exchange::nodal_excess_pressure(snapshot));
}

TEST_F(BesideAPit, TheSlideComesOutAtItsWallAndThePitDoesNotHoldIt) {
    Motion motion = at_rest(model_);
    for (std::size_t row = 0; row < 4; ++row)
        motion.strain[bank(1, row)] = Voigt(0.0, 0.0, 0.0, 0.5);
    for (const std::size_t column : {2u, 3u}) {
        motion.strain[bank(column, 0)] = Voigt(0.0, 0.0, 0.0, 0.5);
        for (std::size_t row = 1; row < 4; ++row)
            for (const std::int32_t node : model_.mesh.quads[bank(column, row)])
                motion.u.segment<2>(2 * static_cast<Eigen::Index>(node)) = Vec2(0.3, -0.4);
    }
    Reading reading;
    watch_.read(model_, motion, {}, reading);
    EXPECT_EQ(reading.failure_surfaces, 1.0);
    EXPECT_NEAR(reading.slip_across_band, 0.5, 1e-12);
}

TEST_F(BesideAPit, AFoldedCornerIsJudgedByTheSoilThatIsThere) {
    Motion motion = at_rest(model_);
    for (std::size_t e = 0; e < model_.body.elements; ++e)
        if (!model_.is_absent(e)) motion.strain[e] = Voigt(0.0, 0.0, 0.0, 0.3);
    Distortion folded;
    folded.worst_element = bank(3, 1);
    const Entanglement what =
        entanglement_of(run_.session().scene().section, model_, watch_, motion, folded, 1.0);
    EXPECT_NEAR(what.mean_epsilon_q, 0.3 / std::sqrt(3.0), 1e-12);
}

TEST_F(BesideAPit, AWatchThatSawTheWholeBodyLooksAnewWhenTheStageBegins) {
    Model model = model_;
    model.absent.clear();
    Watch watch(scene::fem_of(run_.session().scene()), model);
    std::vector<double> epsilon_q(model_.body.elements, 0.0);
    for (const std::size_t e :
         {bank(1, 0), bank(1, 1), bank(1, 2), bank(1, 3), bank(2, 0), bank(3, 0)})
        epsilon_q[e] = 0.5;
    EXPECT_EQ(watch.failure_surfaces(epsilon_q).count, 0u);
    watch.look_at(model_);
    EXPECT_EQ(watch.failure_surfaces(epsilon_q).count, 1u);
}

TEST(Stages, NorSandAnswersAPhreaticRiseDrained) {
    json scene = column_with_water(
        {static_stage("gravity"), static_stage("law", {{"laws", "scene"}}),
         static_stage("rise", {{"laws", "scene"}, {"load_steps", 5}, {"phreatic_line", {{0, 5}}}})},
        1.0);
    scene["fem"]["element"] = "ssp";
    scene["materials"]["soil"]["law"] = bench::cj1(0.03);
    scene["fem"]["force_tolerance"] = 1e-8;
    bench::Run run(scene);
    const Course& done = run.go();
    for (const std::size_t e : {0u, 3u}) {
        const double y = 0.5 + static_cast<double>(e);
        const double expected = -(rho * g * (6.0 - y) - 1000.0 * g * (5.0 - y));
        expect_error("sigma'_yy in NorSand after the rise, row " + std::to_string(e),
                     std::abs(done.motion.points.at(e).sigma[1] / expected - 1.0), 1e-5);
    }
    ASSERT_EQ(done.motion.memory.size(), 2u);
}

/// A free-standing column of clay (c = 20 kPa, phi = 0) with the strength 2 c = 40 kPa, under
/// `pressure`.
json clay_column(double pressure_kPa, double ramp) {
    json scene = column(
        {static_stage("load",
                      {{"laws", "scene"},
                       {"load_steps", 8},
                       {"at_limit", "go_on"},
                       {"surcharge", {{{"from", -1}, {"to", 2}, {"pressure_kPa", pressure_kPa}}}}}),
         {{"type", "dynamic"},
          {"name", "run"},
          {"duration", 0.2},
          {"time_step", 2e-3},
          {"ramp", ramp}}});
    scene["gravity"] = 0.0;
    scene["materials"]["soil"]["law"] = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 20},
        {"phi_deg", 0},           {"psi_deg", 0}};
    json& supports = scene["fem"]["supports"];
    supports.erase(1);
    supports[1]["fixes"] = "y";
    return scene;
}

TEST(Stages, AStaticLimitPointIsAnEventAndTheFailureRunsInMotion) {
    bench::Run failing(clay_column(80.0, 0.01));
    const Course& failed = failing.go();
    const json limit = failing.session().result()["geostatic"]["load"]["limit_point"];
    ASSERT_TRUE(limit.is_number());
    expect_error("load at the limit point, over 2 c / q", std::abs(limit.get<double>() / 0.5 - 1.0),
                 2e-3);
    // Failure is growing kinetic energy: 40 kPa are unbalanced.
    const auto& rows = failed.history;
    ASSERT_GT(rows.size(), 4u);
    EXPECT_GT(rows.back().kinetic_energy, 4.0 * rows.at(rows.size() / 2).kinetic_energy);
    EXPECT_GT(rows.back().kinetic_energy, 1.0);

    bench::Run standing(clay_column(30.0, 0.01));
    const Course& stood = standing.go();
    EXPECT_FALSE(standing.session().result()["geostatic"]["load"].contains("limit_point"));
    EXPECT_LT(stood.history.back().kinetic_energy, 1e-6 * rows.back().kinetic_energy);
}

/// An elastic clay column set in motion by a load; `later` follows after 0.1 s.
json falling_column(double duration, const json& later = nullptr) {
    json scene = column({static_stage("gravity"),
                         {{"type", "dynamic"},
                          {"name", "fall"},
                          {"laws", "elastic"},
                          {"duration", duration},
                          {"time_step", 2e-3},
                          {"surcharge", {{{"from", -1}, {"to", 2}, {"pressure_kPa", 50}}}}}});
    if (!later.is_null()) scene["fem"]["stages"].push_back(later);
    scene["fem"]["force_tolerance"] = 1e-11;
    scene["fem"]["telemetry_interval"] = 0.0;
    return scene;
}

json later_stage(double duration, const json& more) {
    json stage{{"type", "dynamic"},
               {"name", "later"},
               {"laws", "elastic"},
               {"duration", duration},
               {"time_step", 2e-3}};
    stage.update(more);
    return stage;
}

TEST(Stages, ARampWithholdsNothingOfAMotionThatGoesOn) {
    const auto end_of = [](json scene, const json& damping) {
        scene["fem"].update(damping);
        bench::Run run(scene);
        const Course& done = run.go();
        EXPECT_GT(done.motion.v.lpNorm<Eigen::Infinity>(), 0.01) << "it moves";
        return done.motion.u;
    };
    for (const json& damping : {json::object(), json{{"rayleigh_mass", 2.0}},
                                json{{"rayleigh_mass", 1.0}, {"rayleigh_stiffness", 2e-3}}}) {
        const Eigen::VectorXd whole = end_of(falling_column(0.3), damping);
        for (const json& ramp : {json::object(), json{{"ramp", 0.1}}}) {
            const Eigen::VectorXd split =
                end_of(falling_column(0.1, later_stage(0.2, ramp)), damping);
            expect_error(
                "split, " + damping.dump() + ' ' + ramp.dump() + ", over the largest u",
                (split - whole).lpNorm<Eigen::Infinity>() / whole.lpNorm<Eigen::Infinity>(), 1e-9);
        }
    }
}

TEST(Stages, ARampOfALoadInAMotionIsTheSumOfBoth) {
    const auto end_of = [](const json& scene) {
        bench::Run run(scene);
        return run.go().motion.u;
    };
    const auto load = [](double pressure_kPa) {
        return json{{"ramp", 0.1},
                    {"surcharge", {{{"from", -1}, {"to", 2}, {"pressure_kPa", pressure_kPa}}}}};
    };
    // Linear: the effect of a further load does not depend on the present motion.
    json at_rest = falling_column(0.1, later_stage(0.2, load(20)));
    at_rest["fem"]["stages"][1].erase("surcharge");
    const Eigen::VectorXd added = end_of(at_rest);
    const Eigen::VectorXd both = end_of(falling_column(0.1, later_stage(0.2, load(70))));
    const Eigen::VectorXd alone = end_of(falling_column(0.3));
    expect_error("a ramp within a motion, less motion and ramp, over the largest u",
                 (both - alone - added).lpNorm<Eigen::Infinity>() / both.lpNorm<Eigen::Infinity>(),
                 1e-9);
}

TEST(Stages, NodesOfSoilRemovedInMotionStayAndAreNotReported) {
    bench::Run run(falling_column(
        0.05, later_stage(0.3, {{"remove", {"top"}}, {"surcharge", json::array()}})));
    const Course& done = run.go();
    const std::size_t gone = nearest_node(done.model.mesh, {1, 6});
    EXPECT_EQ(done.motion.v.segment<2>(static_cast<Eigen::Index>(2 * gone)).norm(), 0.0);
    double largest = 0.0;
    for (const double y : {1.0, 2.0, 3.0, 4.0})
        for (const double x : {0.0, 1.0}) largest = std::max(largest, u_at(done, {x, y}).norm());
    EXPECT_EQ(run.session().result()["largest_displacement"].get<double>(), largest);
    EXPECT_GT(largest, 0.0);
}

TEST(Stages, AnUnchangedSceneHasNothingAbsent) {
    bench::Run run(column(json::array({static_stage("gravity")})));
    EXPECT_TRUE(run.go().model.absent.empty());
}

TEST(Stages, WhatCannotBeIsRefusedWithItsPlace) {
    EXPECT_EQ(place_refused(column(json::array({static_stage("a", {{"activate", {"nowhere"}}})}))),
              "/fem/stages/0/activate/0");
    EXPECT_EQ(place_refused(column({static_stage("a", {{"activate", {"top"}}}),
                                    static_stage("b", {{"activate", {"top"}}})})),
              "/fem/stages/1/activate/0");
    EXPECT_EQ(place_refused(column({static_stage("a", {{"remove", {"top"}}}),
                                    static_stage("b", {{"remove", {"top"}}})})),
              "/fem/stages/1/remove/0");
    EXPECT_EQ(place_refused(column({static_stage("a"), static_stage("b", {{"remove", {"low"}}})})),
              "/fem/stages/1/remove")
        << "the base holds only the lower region";
    EXPECT_EQ(
        place_refused(column({static_stage("a"), static_stage("b", {{"release", {"base"}}})})),
        "/fem/stages/1");
    EXPECT_EQ(place_refused(column(json::array({static_stage("a", {{"release", {"roof"}}})}))),
              "/fem/stages/0/release/0");
    EXPECT_EQ(place_refused(column(json::array({static_stage("a", {{"at_limit", "go_on"}})}))),
              "/fem/stages/0/at_limit");
    EXPECT_EQ(place_refused(column({static_stage("a"), static_stage("b", line_at(3))})),
              "/fem/stages/1/phreatic_line")
        << "no water to move";
    const auto refused_line = [](const json& line, const json& first = static_stage("a")) {
        return place_refused(
            column_with_water({first, static_stage("b", {{"phreatic_line", line}})}, 2.0));
    };
    EXPECT_EQ(refused_line({{0, -1}}), "/fem/stages/1/phreatic_line") << "below all soil";
    EXPECT_EQ(refused_line({{5, 2}, {9, 3}}), "/fem/stages/1/phreatic_line") << "beside it";
    EXPECT_EQ(refused_line({{0, 5}}, static_stage("dig", {{"remove", {"top"}}})),
              "/fem/stages/1/phreatic_line")
        << "in soil that is gone";
    EXPECT_EQ(refused_line({{0, 3.5}}, static_stage("dig", {{"remove", {"top"}}})), "");
    json wet = column({static_stage("a"), static_stage("b", {{"remove", {"top"}}})});
    wet["fem"]["element"] = "ssp";
    wet["fem"]["water"] = {{"line", {{0, 5}}}};
    wet["materials"]["soil"]["void_ratio"] = 0.8;
    wet["materials"]["soil"]["permeability"] = {1e-6, 1e-6};
    EXPECT_EQ(place_refused(wet), "") << "it drains";
    wet["fem"]["stages"][1]["undrained"] = {"low"};
    EXPECT_EQ(place_refused(wet), "/fem/stages/1");
    wet["fem"]["stages"][1] = {{"type", "dynamic"},
                               {"name", "b"},
                               {"remove", {"top"}},
                               {"duration", 1},
                               {"time_step", 0.1}};
    EXPECT_EQ(place_refused(wet), "/fem/stages/1");
}

}  // namespace
}  // namespace breach::fem::stages_test
