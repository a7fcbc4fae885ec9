// Pore water through scenes: Terzaghi, hydrostatics under gravity, ponded ground, free-field
// columns, rest, refusals.
#include <fstream>
#include <functional>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/model/ground_water.hpp"
#include "fem_solver/snapshot.hpp"
#include "tests/verification/fem/wet.hpp"

namespace breach::fem::wet_scene_test {
namespace {

using bench::expect_error;
using bench::terzaghi;
using bench::WetColumn;
using nlohmann::json;

json dynamic_stage(const char* name, double duration, double time_step) {
    return {{"type", "dynamic"},
            {"name", name},
            {"laws", "elastic"},
            {"duration", duration},
            {"time_step", time_step}};
}

struct Consolidated {
    double error;       ///< largest |p - Terzaghi| / p_0 over the column [-]
    double settlement;  ///< of the top, over that of the drained column [-]
};

/// At T_v, loaded at once, in equal steps.
Consolidated consolidated(WetColumn column, double T_v, int steps) {
    const double end = column.time_of(T_v), q = 1e5;
    column.stages = json::array({dynamic_stage("consolidation", end, end / steps)});
    json scene = column.scene();
    scene["fem"]["newmark_beta"] = 4.0 / 9;
    scene["fem"]["newmark_gamma"] = 5.0 / 6;
    scene["fem"]["surcharge"] = {{{"from", 0}, {"to", 1}, {"pressure_kPa", q / 1e3}}};
    bench::Run run(scene);
    const Course& a = run.go();
    double largest = 0.0;
    for (std::size_t i = 0; i < a.model.mesh.nodes.size(); ++i) {
        const double y = a.model.mesh.nodes[i].y();
        const double p = a.motion.p[static_cast<Eigen::Index>(i)] / (q * column.share());
        largest = std::max(largest, std::abs(p - terzaghi(y, column.H, T_v)));
    }
    return {largest, bench::u_at(a, {0.0, column.H}).y() / (-q * column.H / column.modulus())};
}

double consolidation_error(const WetColumn& column, double T_v, int steps) {
    return consolidated(column, T_v, steps).error;
}

TEST(Terzaghi, OfASceneIsMetWithinOnePercentFromTimeFactor005) {
    for (const char* element : {"ssp", "bbar"}) {
        const WetColumn column{.rows = 40, .element = element};
        for (const double T_v : {0.05, 0.2, 0.5}) {
            expect_error(std::string(element) + ": largest |p - Terzaghi| / p_0 at T_v " +
                             std::to_string(T_v),
                         consolidation_error(column, T_v, 400), 0.01);
        }
    }
}

TEST(Terzaghi, ErrorFallsWithStepAndMesh) {
    double by_step[3], by_mesh[3];
    for (int k = 0; k < 3; ++k) {
        by_step[k] = consolidation_error({.rows = 80}, 0.05, 50 << k);
        by_mesh[k] = consolidation_error({.rows = 10 << k}, 0.05, 1600);
    }
    std::printf("    steps 50, 100, 200: %.2e %.2e %.2e; rows 10, 20, 40: %.2e %.2e %.2e\n",
                by_step[0], by_step[1], by_step[2], by_mesh[0], by_mesh[1], by_mesh[2]);
    EXPECT_LT(by_step[2], 0.6 * by_step[1]) << "first order in the step";
    EXPECT_LT(by_mesh[2], 0.35 * by_mesh[1]) << "second order in the mesh";
}

TEST(Terzaghi, HoldsWithWaterAThousandTimesSofterThanTheSkeleton) {
    for (const char* element : {"ssp", "bbar"}) {
        WetColumn column{.rows = 40, .element = element};
        column.K_f = 1e-3 * column.modulus() * column.porosity();
        for (const double T_v : {0.05, 0.5}) {
            const Consolidated soft = consolidated(column, T_v, 400);
            expect_error(std::string(element) + ", K_f/n 1e-3 M: |p - Terzaghi| / p_0 at T_v " +
                             std::to_string(T_v),
                         soft.error, 0.01);
            // Water that takes a thousandth of the load does not change the skeleton's settlement.
            expect_error("... settlement against the drained one", std::abs(soft.settlement - 1.0),
                         1e-3);
        }
    }
}

struct Newmarks {
    double beta, gamma;
};

/// A load applied over 10 s with short steps, then steps 1.6e5 times as long: the velocity at the
/// end of the ramp must not be extrapolated.
Consolidated behind_a_ramp(WetColumn column, const Newmarks& newmark) {
    const double end = column.time_of(0.1), q = 1e5;
    json load = dynamic_stage("load", 10.0, 0.5);
    load["ramp"] = 10.0;
    load["surcharge"] = {{{"from", 0}, {"to", 1}, {"pressure_kPa", q / 1e3}}};
    column.stages = json::array({{{"type", "static"}, {"name", "rest"}, {"laws", "elastic"}},
                                 load,
                                 dynamic_stage("wait", end - 10.0, 0.1 * end)});
    json scene = column.scene();
    scene["fem"]["force_tolerance"] = 1e-6;
    scene["fem"]["newmark_beta"] = newmark.beta;
    scene["fem"]["newmark_gamma"] = newmark.gamma;
    bench::Run run(scene);
    const Course& a = run.go();
    std::printf("    %lld steps\n", static_cast<long long>(a.position.step));
    const auto base = static_cast<Eigen::Index>(nearest_node(a.model.mesh, {0.0, 0.0}));
    const double p = (a.motion.p[base] - a.beginning.p[base]) / (q * column.share());
    // Settlement relative to the drained one: 1 - mean p / p_0, sqrt(4 T_v / pi) for T_v < 0.2.
    const double settled = bench::u_at(a, {0.0, column.H}).y() / (-q * column.H / column.modulus());
    return {std::abs(p - terzaghi(0.0, column.H, 0.1)),
            settled - (1.0 - column.share() * (1.0 - std::sqrt(0.4 / std::numbers::pi)))};
}

TEST(Terzaghi, IsMetByLongStepsBehindAShortRamp) {
    for (const char* element : {"bbar", "ssp"}) {
        for (const Newmarks newmark : {Newmarks{0.3025, 0.6}, {4.0 / 9, 5.0 / 6}, {0.25, 0.5}}) {
            for (const double k : {1e-8, 1e-7, 1e-6}) {
                const WetColumn column{.k = k, .gravity = 9.81, .element = element};
                const Consolidated now = behind_a_ramp(column, newmark);
                const std::string what = std::string(element) + ", k " + std::to_string(k * 1e6) +
                                         "e-6, gamma " + std::to_string(newmark.gamma);
                expect_error(what + ": |p - Terzaghi| / p_0 at the base", now.error, 0.02);
                expect_error(what + ": settlement over the drained one", std::abs(now.settlement),
                             0.02);
            }
        }
    }
}

/// Loaded at once; a snapshot is requested shortly after step `at`.
Consolidated with_snapshot(WetColumn column, const Newmarks& newmark, std::optional<double> at) {
    const double end = column.time_of(0.2), step = end / 100, q = 1e5;
    column.stages = json::array({dynamic_stage("consolidation", end, step)});
    json scene = column.scene();
    scene["fem"]["newmark_beta"] = newmark.beta;
    scene["fem"]["newmark_gamma"] = newmark.gamma;
    scene["fem"]["surcharge"] = {{{"from", 0}, {"to", 1}, {"pressure_kPa", q / 1e3}}};
    if (at) scene["fem"]["snapshot_times"] = {*at * step};
    bench::Run run(scene);
    const Course& a = run.go();
    std::printf("    %lld steps\n", static_cast<long long>(a.position.step));
    const auto base = static_cast<Eigen::Index>(nearest_node(a.model.mesh, {0.0, 0.0}));
    return {a.motion.p[base] / (q * column.share()),
            bench::u_at(a, {0.0, column.H}).y() / (-q * column.H / column.modulus())};
}

TEST(Snapshots, OffTheGridOfStepsLeaveTheResultsAsTheyAre) {
    for (const char* element : {"bbar", "ssp"}) {
        for (const Newmarks newmark : {Newmarks{0.3025, 0.6}, {4.0 / 9, 5.0 / 6}, {0.25, 0.5}}) {
            const WetColumn column{.element = element};
            const Consolidated without = with_snapshot(column, newmark, std::nullopt);
            for (const double at : {0.005, 0.02, 0.06, 1.06}) {
                // Without damping, the pressure oscillates permanently after a short first step.
                if (newmark.gamma == 0.5 && at < 1.0) continue;
                const Consolidated now = with_snapshot(column, newmark, at);
                const std::string what = std::string(element) + ", gamma " +
                                         std::to_string(newmark.gamma) + ", snapshot at step " +
                                         std::to_string(at);
                expect_error(what + ": p at the base, over p_0",
                             std::abs(now.error - without.error), 0.01);
                expect_error("... settlement over the drained one",
                             std::abs(now.settlement - without.settlement), 0.01);
            }
        }
    }
}

TEST(Permeability, OfZeroIsRefusedWithPlaceAndRemedy) {
    for (const int way : {0, 1}) {
        json scene = WetColumn{}.scene();
        scene["materials"]["soil"]["permeability"][way] = 0.0;
        try {
            bench::parse(scene);
            ADD_FAILURE() << "no water could ever leave";
        } catch (const fault::BadInput& refused) {
            ASSERT_EQ(refused.faults().size(), 1u);
            const fault::Fault& what = refused.faults()[0];
            EXPECT_EQ(what.pointer, "/materials/soil/permeability/" + std::to_string(way));
            EXPECT_NE(what.cause.find("0"), std::string::npos) << what.cause;
            EXPECT_FALSE(what.remedy.empty());
            std::printf("    %s: %s; %s\n", what.pointer.c_str(), what.cause.c_str(),
                        what.remedy.c_str());
        }
    }
}

json gravity(const char* element) {
    WetColumn column{.gravity = 9.81, .element = element};
    return column.scene();
}

TEST(Hydrostatics, OfASceneAreExact) {
    for (const char* element : {"ssp", "bbar"}) {
        bench::Run run(gravity(element));
        const Course& a = run.go();
        double p_error = 0.0, s_error = 0.0;
        for (std::size_t i = 0; i < a.model.mesh.nodes.size(); ++i) {
            const double depth = 10.0 - a.model.mesh.nodes[i].y();
            const double p = a.motion.p[static_cast<Eigen::Index>(i)];
            p_error = std::max(p_error, std::abs(p - 9810.0 * depth) / 98100.0);
        }
        const std::size_t points = a.model.points_per_element;
        for (std::size_t e = 0; e < a.model.mesh.quads.size(); ++e) {
            const double depth = 10.0 - corners_of(a.model.mesh, e).row(1).mean();
            double sigma = 0.0;
            for (std::size_t g = 0; g < points; ++g) {
                sigma += a.motion.points[e * points + g].sigma[1] / static_cast<double>(points);
            }
            s_error = std::max(s_error, std::abs(sigma + 9810.0 * depth) / 98100.0);
        }
        expect_error(std::string(element) + ": p = rho_f g depth at the nodes", p_error, 1e-8);
        expect_error(std::string(element) + ": sigma'_v = (rho - rho_f) g depth", s_error, 1e-8);
    }
}

/// A section of 20 m by 10 m in elements of 2 m, for any line.
json drawn_line(const char* element, const char* above, const json& line) {
    WetColumn column{
        .H = 10.0, .width = 20.0, .gravity = 9.81, .rows = 5, .columns = 10, .element = element};
    json scene = column.scene();
    scene["fem"]["water"]["line"] = line;
    scene["fem"]["water"]["above"] = above;
    return scene;
}

/// Largest |p - rho_f g depth| of the nodes and largest difference of an element's mean sigma'_v
/// from its closed form, away from the sides by `margin`, over 98.1 kPa.
struct Drawn {
    double p, sigma;
};

Drawn drawn_and_computed(const json& scene, const std::function<double(double)>& level,
                         double margin = 0.0) {
    bench::Run run(scene);
    const Course& a = run.go();
    const Mesh& mesh = a.model.mesh;
    const exchange::MeshSnapshot told =
        snapshot_of(run.session().scene(), a.model, a.motion, a.beginning, {}, 0.0, 0);
    Drawn largest{0.0, 0.0};
    const auto water = [&](const Vec2& x) { return 9810.0 * std::max(0.0, level(x.x()) - x.y()); };
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        largest.p = std::max(largest.p, std::abs(told.pore_pressure[i] - water(mesh.nodes[i])));
    const std::size_t points = a.model.points_per_element;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = corners_of(mesh, e);
        if (std::abs(x.row(0).mean() - 10.0) > 10.0 - margin) continue;
        double sigma = 0.0, u = 0.0;
        for (std::size_t g = 0; g < points; ++g)
            sigma -= a.motion.points[e * points + g].sigma[1] / static_cast<double>(points);
        constexpr int n = 200;  // mean of the water's pressure over the element
        for (int i = 0; i < n; ++i)
            u += water({x.row(0).mean(), x(1, 0) + 2.0 * (i + 0.5) / n}) / n;
        const double depth = 10.0 - x.row(1).mean();
        largest.sigma = std::max(largest.sigma, std::abs(sigma - 2e3 * 9.81 * depth + u));
    }
    return {largest.p / 98.1e3, largest.sigma / 98.1e3};
}

TEST(PhreaticLine, IsTakenAsDrawnWhereverTheRowsLie) {
    for (const char* element : {"ssp", "bbar"}) {
        for (const char* above : {"drained", "dry"}) {
            for (const double level : {6.4, 7.0, 7.5, 8.0, 8.3, 9.9}) {
                const Drawn now = drawn_and_computed(drawn_line(element, above, {{0, level}}),
                                                     [&](double) { return level; });
                const std::string what =
                    std::string(element) + ", " + above + ", " + std::to_string(level) + " m: ";
                expect_error(what + "p", now.p, 1e-8);
                expect_error(what + "mean sigma'_v", now.sigma, 1e-5);
            }
        }
    }
}

TEST(PhreaticLine, ThatSlopesIsTakenAsDrawn) {
    for (const char* element : {"ssp", "bbar"}) {
        for (const char* above : {"drained", "dry"}) {
            const Drawn now = drawn_and_computed(
                drawn_line(element, above, {{0, 8.5}, {20, 6.5}}),
                [](double x) { return 8.5 - 0.1 * x; }, 6.0);
            expect_error(std::string(element) + ", " + above + ", 1 in 10: p", now.p, 1e-8);
            // The sides carry the difference of the water's thrust, which shifts the weight beside
            // them.
            expect_error("... mean sigma'_v", now.sigma, 0.01);
        }
    }
}

/// A dam of 10 m with a core down to rock, and a reservoir of 9 m at its left.
json dam_with_reservoir() {
    json scene = drawn_line("bbar", "drained", {{0, 9}, {30, 9}, {34, 1}, {44, 0}, {64, 0}});
    json& soil = scene["materials"]["soil"];
    soil["law"] = {
        {"type", "mohr_coulomb"}, {"E_MPa", 50}, {"nu", 0.35}, {"c_kPa", 1}, {"phi_deg", 30}};
    json& regions = scene["section"]["regions"] = json::array();
    const auto region = [&](const char* name, json ring) {
        ring.push_back(ring[0]);
        regions.push_back({{"name", name},
                           {"material", "soil"},
                           {"polygon", ring},
                           {"mesh", {{"type", "unstructured"}, {"element_size", 2}}}});
    };
    region("left", {{0, -4}, {30, -4}, {30, 0}, {10, 0}, {0, 0}});
    region("right", {{34, -4}, {64, -4}, {64, 0}, {54, 0}, {34, 0}});
    region("core", {{30, -4}, {34, -4}, {34, 0}, {34, 10}, {30, 10}, {30, 0}});
    region("upstream", {{10, 0}, {30, 0}, {30, 10}});
    region("downstream", {{34, 0}, {54, 0}, {34, 10}});
    const auto support = [](const char* name, json from, json to, const char* fixes) {
        return json{{"name", name}, {"from", from}, {"to", to}, {"fixes", fixes}};
    };
    json& fem = scene["fem"];
    fem["supports"] = {support("left", {0, -4}, {0, 0}, "x"),
                       support("right", {64, -4}, {64, 0}, "x"),
                       support("base", {0, -4}, {64, -4}, "xy")};
    fem["stages"] = {{{"type", "static"}, {"name", "elastic"}},
                     {{"type", "static"}, {"name", "plastic"}, {"laws", "scene"}}};
    fem["crest"] = {32, 10};
    fem["force_tolerance"] = 1e-6;
    return scene;
}

TEST(PhreaticLine, ThatSlopesWithoutBoundariesIsRefusedWithTheSeepageThatHelps) {
    json scene = dam_with_reservoir();
    std::string message;
    try {
        bench::Run(scene).go();
    } catch (const std::exception& refused) {
        message = refused.what();
    }
    const std::string sets = "--set '/fem/water/boundaries=";
    const std::size_t begin = message.find(sets);
    ASSERT_NE(begin, std::string::npos) << "stands, or names no seepage: " << message;
    const std::size_t from = begin + sets.size();
    scene["fem"]["water"]["boundaries"] =
        json::parse(message.substr(from, message.find('\'', from) - from));
    bench::Run seeps(scene);
    EXPECT_NO_THROW(seeps.go());
    const auto remedy = [](const json& of) { return seepage_remedy(bench::parse(of), 0); };
    EXPECT_EQ(remedy(scene), "") << "water flows already";
    EXPECT_EQ(remedy(drawn_line("ssp", "drained", {{0, 8}, {20, 8}})), "");
}

TEST(PhreaticLine, BetweenRowsLeavesAColumnAtRest) {
    json scene = drawn_line("ssp", "drained", {{0, 8.5}, {20, 6.5}});
    scene["fem"]["stages"].push_back(dynamic_stage("wait", 1e4, 100.0));
    bench::Run run(scene);
    const Course& a = run.go();
    expect_error("change of pressure [Pa] in 1e4 s",
                 (a.motion.p - a.beginning.p).lpNorm<Eigen::Infinity>(), 1e-2);
}

TEST(Pond, LoadsTheGroundAndLeavesTheEffectiveStress) {
    json dry_top = gravity("ssp"), ponded = dry_top;
    ponded["fem"]["water"]["line"] = {{0, 13}};
    bench::Run one(dry_top), two(ponded);
    const Course &a = one.go(), &b = two.go();
    double p_error = 0.0, s_error = 0.0;
    for (Eigen::Index i = 0; i < a.motion.p.size(); ++i) {
        const double more = b.motion.p[i] - a.motion.p[i];
        p_error = std::max(p_error, std::abs(more - 3.0 * 9810.0) / 29430.0);
    }
    for (std::size_t e = 0; e < a.motion.points.size(); ++e) {
        s_error =
            std::max(s_error, (b.motion.points[e].sigma - a.motion.points[e].sigma).norm() / 1e5);
    }
    expect_error("3 m of water above: pressure grows by its weight everywhere", p_error, 1e-8);
    expect_error("... and the effective stress does not change", s_error, 1e-9);
}

/// Level ground over rock, wet to 2 m below its surface, with columns, shaken by a pulse.
json level_ground(double thickness_factor, const std::filesystem::path& motion) {
    const double W = 8.0, H = 10.0, duration = 1.5, dt = 0.005;
    json scene = bench::scene_of({.width = W,
                                  .height = H,
                                  .columns = 4,
                                  .rows = 10,
                                  .law = {{"type", "linear_elastic"}, {"E_MPa", 100}, {"nu", 0.3}},
                                  .stages = {{{"type", "static"}, {"name", "gravity"}},
                                             dynamic_stage("shaking", duration, dt)}});
    json& fem = scene["fem"];
    fem["supports"] =
        json::array({{{"name", "base"}, {"from", {0, 0}}, {"to", {W, 0}}, {"fixes", "xy"}}});
    fem["element"] = "ssp";
    fem["force_tolerance"] = 1e-9;
    fem["telemetry_interval"] = 0.0;
    fem["water"] = {{"line", {{0, H - 2.0}}}};
    fem["base"] = {{"density", 2300}, {"V_s", 760}};
    fem["free_field"] = {{"width", 1.5}, {"thickness_factor", thickness_factor}};
    if (!motion.empty()) fem["motion"] = {{"file", motion.string()}};
    scene["materials"]["soil"]["void_ratio"] = 0.8;
    scene["materials"]["soil"]["permeability"] = {1e-5, 1e-5};
    return scene;
}

std::filesystem::path pulse(const bench::Folder& folder) {
    const auto file = folder.path() / "pulse.csv";
    std::ofstream out(file);
    out << "time_s,velocity_m_s\n";
    for (int i = 0; i <= 200; ++i) {
        const double t = 0.005 * i;
        out << t << ',' << 0.2 * std::exp(-std::pow((t - 0.4) / 0.08, 2)) << '\n';
    }
    return file;
}

// Level ground has no dam: its columns are the whole model, and their base is the mesh's. Only
// Newton's tolerance remains.
TEST(FreeField, TheColumnsAloneMoveTheBaseOfLevelGroundAsTheMeshDoes) {
    const bench::Folder folder;
    json scene = level_ground(1e4, pulse(folder));
    bench::Run run(scene);
    const Course& a = run.go();
    const exchange::BaseMotion& ground = a.beginning.base_motion;
    ASSERT_TRUE(ground.any());
    const motion::Series velocity{ground.time_step, ground.velocity};
    double apart = 0.0;
    for (const Reading& each : a.history) {
        apart =
            std::max(apart, std::abs(each.base_velocity - motion::value_at(velocity, each.time)));
    }
    const double peak = motion::peak(velocity);
    EXPECT_GT(peak, 0.05);
    expect_error("largest difference over the peak velocity", apart / peak, 1e-7);
    EXPECT_NEAR(velocity.duration(), std::max(1.0, a.position.time), 1e-9)
        << "to the end of the earthquake or of the stages";
    const exchange::MeshSnapshot last =
        exchange::read_mesh_snapshot(run.folder() / phases::files::snapshot_name(a.position.time))
            .snapshot;
    EXPECT_EQ(last.base_motion.velocity, ground.velocity);
    EXPECT_EQ(last.base_motion.time_step, ground.time_step);
    EXPECT_TRUE(std::filesystem::exists(run.folder() / "base_motion.csv"));
}

TEST(FreeField, WithoutColumnsNothingIsKnownOfTheFreeGround) {
    const bench::Folder folder;
    json scene = level_ground(1e4, pulse(folder));
    scene["fem"].erase("free_field");
    bench::Run run(scene);
    EXPECT_FALSE(run.go().beginning.base_motion.any());
    const auto& flags = run.session().flags();
    EXPECT_TRUE(std::ranges::any_of(
        flags, [](const fault::Flag& each) { return each.code == "no_base_motion"; }));
}

// The stress on the body's vertical side pulls the column; the column's inner side, counted once
// for the body, carries it. Without that the middle differs by 1e-6 at 1e2, 1e-8 at 1e4 (measured).
// Only Newton's tolerance remains.
TEST(FreeField, LevelGroundMovesAlikeAtTheColumnAndInTheMiddle) {
    const bench::Folder folder;
    const auto file = pulse(folder);
    constexpr double factors[] = {1.0, 1e2, 1e4};
    std::vector<double> histories[3];
    for (const int k : {0, 1, 2}) {
        json scene = level_ground(factors[k], file);
        scene["fem"]["force_tolerance"] = 1e-12;
        scene["fem"]["largest_iterations"] = 200;  // a thin column's share is not in the matrix
        bench::Run run(scene);
        const Course& a = run.go();
        for (const Reading& reading : a.history) histories[k].push_back(reading.crest_dx);
        const auto at = [&](const Vec2& x) {
            return a.motion.u[2 * static_cast<Eigen::Index>(nearest_node(a.model.mesh, x))];
        };
        const double largest = a.motion.u.lpNorm<Eigen::Infinity>();
        expect_error("u_x in the middle less u_x at the column, over the largest",
                     std::abs(at({4.0, 10.0}) - at({-1.5, 10.0})) / largest, 1e-10);
        std::printf("    thickness factor %g: %lld iterations\n", factors[k],
                    static_cast<long long>(run.session().result()["iterations"].get<int>()));
        EXPECT_GT(largest, 1e-3);
    }
    for (const int k : {0, 1}) {
        double change = 0.0, largest = 0.0;
        for (std::size_t n = 0; n < histories[2].size(); ++n) {
            change = std::max(change, std::abs(histories[k][n] - histories[2][n]));
            largest = std::max(largest, std::abs(histories[2][n]));
        }
        expect_error(k == 0 ? "thickness factor 1 to 1e4: change over the largest"
                            : "thickness factor 1e2 to 1e4: change over the largest",
                     change / largest, 2e-10);
    }
}

TEST(FreeField, ASurchargeToTheSidesLiesOnTheColumnsToo) {
    const auto loaded = [](double from, double to) {
        json scene = level_ground(1e4, {});
        scene["fem"].erase("water");
        scene["fem"]["stages"].erase(1);
        scene["fem"]["surcharge"] = {{{"from", from}, {"to", to}, {"pressure_kPa", 200}}};
        bench::Run run(scene);
        return run.go().motion.u;
    };
    const Eigen::VectorXd everywhere = loaded(-1e3, 1e3);
    EXPECT_EQ(loaded(0.0, 8.0), everywhere);
    const Eigen::VectorXd right = loaded(4.0, 8.0);
    EXPECT_NE(right, everywhere);
    // Here the left column carries nothing.
    const Model model = bench::model_of(bench::parse(level_ground(1e4, {})));
    const auto y_of = [&](const Vec2& x) {
        return right[2 * static_cast<Eigen::Index>(nearest_node(model.mesh, x)) + 1];
    };
    EXPECT_LT(y_of({9.5, 10.0}), 1.5 * y_of({-1.5, 10.0}));
}

TEST(FreeField, TheWorksAreThoseOfTheBody) {
    const bench::Folder folder;
    const auto file = pulse(folder);
    const auto last_of = [&](double thickness_factor, nlohmann::json& hourglass) {
        json scene = level_ground(thickness_factor, file);
        scene["fem"]["largest_iterations"] = 200;
        scene["fem"]["stages"][1]["surcharge"] = {{{"from", 0}, {"to", 8}, {"pressure_kPa", 20}}};
        bench::Run run(scene);
        const Reading last = run.go().history.back();
        hourglass = run.session().result()["hourglass"];
        return last;
    };
    nlohmann::json thin, thick;
    const Reading one = last_of(1.0, thin), two = last_of(1e4, thick);
    EXPECT_GT(std::abs(one.external_work), 1.0);
    EXPECT_GT(std::abs(one.internal_work), 1.0);
    expect_error("external work, thickness factor 1e4 over 1",
                 std::abs(two.external_work / one.external_work - 1.0), 1e-4);
    expect_error("internal work, thickness factor 1e4 over 1",
                 std::abs(two.internal_work / one.internal_work - 1.0), 1e-4);
    EXPECT_LT(thick["energy"].get<double>(), 1e-3 * std::abs(one.internal_work));
}

TEST(FreeField, TheColumnsAloneSoftenAsTheStageSays) {
    const bench::Folder folder;
    const auto file = pulse(folder);
    const auto base_of = [&](double S_of_law, const json& S_of_stage) {
        json scene = level_ground(1e4, file);
        scene["materials"]["soil"]["law"] = bench::cj1(0.06);
        scene["materials"]["soil"]["law"]["S"] = S_of_law;
        json& fem = scene["fem"];
        fem["force_tolerance"] = 1e-6;
        fem["largest_iterations"] = 100;
        json& stages = fem["stages"];
        stages[1].erase("laws");
        stages.insert(stages.begin() + 1, bench::static_stage("law", {{"laws", "scene"}}));
        if (!S_of_stage.is_null()) stages[2]["S"] = S_of_stage;
        bench::Run run(scene);
        return run.go().beginning.base_motion.velocity;
    };
    const auto own = base_of(0.0, nullptr);
    EXPECT_EQ(base_of(1.0, 0.0), own);
    EXPECT_EQ(base_of(1.0, {{"block", 0}}), own);
    EXPECT_NE(base_of(1.0, nullptr), own);
}

TEST(Rest, WithoutMotionNothingDrifts) {
    json scene = level_ground(1e3, {});
    scene["fem"]["stages"][1]["duration"] = 10.0;
    scene["fem"]["stages"][1]["time_step"] = 0.01;
    bench::Run run(scene);
    const Course& a = run.go();
    double drift = 0.0;
    for (Eigen::Index i = 0; i < a.motion.p.size(); ++i) {
        drift = std::max(drift, std::abs(a.motion.p[i] - a.beginning.p[i]));
    }
    expect_error("displacement after 10 s of rest over rock [m]",
                 a.motion.u.lpNorm<Eigen::Infinity>(), 1e-8);
    expect_error("change of pressure [Pa] (largest 8e4)", drift, 1e-3);
}

TEST(FreeField, ASideThatIsHeldIsRefused) {
    json scene = level_ground(1e3, {});
    scene["fem"]["supports"].push_back(
        {{"name", "side"}, {"from", {0, 0}}, {"to", {0, 10}}, {"fixes", "x"}});
    EXPECT_THROW(bench::model_of(bench::parse(scene)), fault::BadInput);
}

}  // namespace
}  // namespace breach::fem::wet_scene_test
