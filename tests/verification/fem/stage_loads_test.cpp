// Stage actions on parts of the body: loads, moved edges, softening by region; against closed
// forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/fem/bench.hpp"

namespace breach::fem::stage_loads_test {
namespace {

using bench::cj1;
using bench::expect_error;
using bench::place_refused;
using bench::static_stage;
using bench::u_at;
using nlohmann::json;

constexpr double E = 20e6, nu = 0.3, q = 50e3;
constexpr double M = E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));  // one-dimensional [Pa]
constexpr double G = E / (2.0 * (1.0 + nu));

json pressed(double kPa) {
    return {{"surcharge", {{{"from", -1}, {"to", 9}, {"pressure_kPa", kPa}}}}};
}

/// Force, and its moment about the origin along x and y, of all nodes [N, N m].
struct Sum {
    Vec2 force = Vec2::Zero();
    double of_down_along_x = 0.0, of_right_along_y = 0.0;
};

Sum sum_of_loads(const json& scene) {
    bench::Run run(scene);
    const Model& model = run.go().model;
    Sum sum;
    for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i) {
        const Vec2 f = model.external_force.segment<2>(static_cast<Eigen::Index>(2 * i));
        sum.force += f;
        sum.of_down_along_x += f.y() * model.mesh.nodes[i].x();
        sum.of_right_along_y += f.x() * model.mesh.nodes[i].y();
    }
    return sum;
}

/// Elements of 2 m.
json coarse(const json& load, double gravity = 0.0) {
    return bench::scene_of({.width = 8.0,
                            .height = 8.0,
                            .columns = 4,
                            .rows = 4,
                            .gravity = gravity,
                            .stages = json::array({static_stage("load", load)})});
}

TEST(Loads, ThatEndWithinAnElementCountAsDrawn) {
    for (const auto& [from, to] :
         {std::pair(3.0, 5.0), std::pair(0.1, 0.9), std::pair(-1.0, 7.0)}) {
        const double left = std::max(from, 0.0), force = 100e3 * (to - left);
        const Sum sum = sum_of_loads(
            coarse({{"surcharge", {{{"from", from}, {"to", to}, {"pressure_kPa", 100}}}}}));
        EXPECT_NEAR(sum.force.y(), -force, 1e-6);
        EXPECT_NEAR(sum.of_down_along_x, -force * 0.5 * (left + to), 1e-6);
    }
    const Sum beside = sum_of_loads(
        coarse({{"pressures",
                 {{{"name", "side"}, {"from", {8, 1}}, {"to", {8, 6}}, {"pressure_kPa", 100}}}}}));
    EXPECT_NEAR(beside.force.x(), -500e3, 1e-6);
    EXPECT_NEAR(beside.of_right_along_y, -500e3 * 3.5, 1e-5);
}

TEST(Loads, OfAPondEndAtItsShore) {
    const auto under = [](double level) {
        json scene = coarse(json::object(), 10.0);
        const json corners{{0, 0}, {8, 0}, {8, 2}, {0, 6}};
        json& region = scene["section"]["regions"][0];
        region["polygon"] = {{0, 0}, {8, 0}, {8, 2}, {0, 6}, {0, 0}};
        region["mesh"]["corners"] = corners;
        scene["fem"]["supports"][0]["to"] = {0, 6};
        scene["fem"]["supports"][1]["to"] = {8, 2};
        scene["fem"]["crest"] = {0, 6};
        scene["materials"]["soil"].update({{"void_ratio", 0.8}, {"permeability", {1e-6, 1e-6}}});
        scene["fem"]["water"] = {{"line", {{0, level}}}, {"density", 1000}};
        return sum_of_loads(scene).force;
    };
    // The shore is at x = 3, the pond 2.5 m deep at x = 8.
    const Vec2 pond = under(4.5) - under(0.0);
    EXPECT_NEAR(pond.y(), -10e3 * 0.5 * 5.0 * 2.5, 1e-3);
    EXPECT_NEAR(pond.x(), -10e3 * 0.5 * 2.5 * 2.5, 1e-3);
}

TEST(DisplacedEdges, ThrustHasAllThatTheSupportBeforeGave) {
    // 50 kPa on top between smooth walls; then the left one is moved in twice by 1 mm.
    constexpr double at_rest = nu / (1.0 - nu) * q, per_metre = E / (1.0 - nu * nu);
    const json drive = {{{"name", "wall"}, {"from", {0, 0}}, {"to", {0, 1}}, {"x", 1e-3}}};
    json scene = bench::scene_of(
        {.columns = 2,
         .rows = 2,
         .gravity = 0.0,
         .stages = {
             static_stage("rest", pressed(q / 1e3)),
             static_stage("in", {{"release", {"left"}}, {"load_steps", 4}, {"displace", drive}}),
             static_stage("farther in", {{"load_steps", 4}, {"displace", drive}})}});
    scene["fem"]["supports"][2]["fixes"] = "y";
    bench::Run run(scene);
    run.go();
    for (int n = 0; n < 2; ++n) {
        const std::string stage = n == 0 ? "in" : "farther in";
        const json& path = run.session().result()["geostatic"][stage]["displaced"]["wall"];
        ASSERT_EQ(path.size(), 4u);
        double largest = 0.0;
        for (const json& at : path) {
            const double moved = 1e-3 * (n + at["load"].get<double>());
            largest = std::max(
                largest,
                std::abs(at["force_x"].get<double>() / (at_rest + per_metre * moved) - 1.0));
        }
        expect_error(stage + ": thrust at the wall", largest, 1e-8);
    }
}

json moved(const Vec2& from, const Vec2& to, const json& by) {
    json edge{{"name", "edge"}, {"from", {from.x(), from.y()}}, {"to", {to.x(), to.y()}}};
    edge.update(by);
    return json::array({edge});
}

/// A block 2 m wide under its weight; `drives`: its further stages.
json heavy_block(const std::vector<json>& drives) {
    json stages = json::array({static_stage("gravity")});
    for (const json& each : drives) stages.push_back(each);
    return bench::scene_of(
        {.width = 2.0, .height = 2.0, .columns = 4, .rows = 4, .stages = stages});
}

TEST(DisplacedEdges, ABaseThatMovesDownCarriesTheBodyWithItWithoutStress) {
    const json down = {{"x", 0.0}, {"y", -0.01}};
    bench::Run at_rest(heavy_block({}));
    const Course& still = at_rest.go();
    for (const bool part : {false, true}) {
        // smooth walls keep a body upright on a part of its base, too
        const json edge = moved({0, 0}, {part ? 0.5 : 2.0, 0}, down);
        json scene = heavy_block({static_stage("d", {{"release", {"base"}}, {"displace", edge}}),
                                  static_stage("e", {{"displace", edge}})});
        bench::Run run(scene);
        const Course& done = run.go();
        double weight = 0.0, fall = 0.0, strain = 0.0;
        for (const json& at : run.session().result()["geostatic"]["e"]["displaced"]["edge"])
            weight = at["force_y"];
        for (const double x : {0.0, 0.5})
            fall = std::max(fall, std::abs(u_at(done, {x, 0}).y() + 0.02) / 0.02);
        for (std::size_t p = 0; p < done.motion.points.size(); ++p)
            strain = std::max(strain, (done.motion.points[p].sigma - still.motion.points[p].sigma)
                                          .lpNorm<Eigen::Infinity>());
        const std::string name = part ? "part of the base: " : "whole base: ";
        expect_error(name + "fall", fall, 1e-12);
        expect_error(name + "force, over the weight",
                     std::abs(weight / (2000.0 * 9.81 * 4.0) - 1.0), 1e-8);
        if (!part) expect_error(name + "new stress, over the weight's", strain / 40e3, 1e-8);
    }
}

TEST(DisplacedEdges, HoldTheBodyInTheDirectionsThatTheyMove) {
    const auto refused = [](const json& by, const json& release) {
        return place_refused(heavy_block(
            {static_stage("d", {{"release", release}, {"displace", moved({0, 0}, {2, 0}, by)}})}));
    };
    const json all = {"left", "right", "base"};
    EXPECT_EQ(refused({{"x", 0.0}, {"y", 0.0}}, all), "");
    EXPECT_EQ(refused({{"x", 1e-3}}, {"left", "right"}), "");
    EXPECT_EQ(refused({{"x", 1e-3}}, all), "/fem/stages/1");
    EXPECT_EQ(refused({{"y", 1e-3}}, all), "/fem/stages/1");
    // From the first stage on, and in a stage in motion.
    json scene = heavy_block({});
    scene["fem"]["supports"].erase(2);
    EXPECT_EQ(place_refused(scene), "/fem/supports");
    scene["fem"]["stages"][0]["displace"] = moved({0, 0}, {2, 0}, {{"y", 0.0}});
    EXPECT_EQ(place_refused(scene), "");
    scene["fem"]["stages"].push_back(
        {{"type", "dynamic"}, {"name", "z"}, {"duration", 0.1}, {"time_step", 0.05}});
    bench::Run run(scene);
    const Course& done = run.go();
    EXPECT_LT(done.motion.u.lpNorm<Eigen::Infinity>(), 1e-9) << "the block rests on its edge";
}

/// A saturated column of CJ1, two regions of 2 m, each of its own material, compressed dynamically.
json two_soils(double S_low, double S_top, const json& S_of_stage) {
    json scene = bench::scene_of({.height = 2.0, .rows = 2, .law = cj1(0.03)});
    json& region = scene["section"]["regions"][0];
    json top = region;
    region["name"] = "low";
    top["name"] = "top";
    top["material"] = "silt";
    top["polygon"] = {{0, 2}, {1, 2}, {1, 4}, {0, 4}, {0, 2}};
    scene["section"]["regions"].push_back(top);
    scene["materials"]["silt"] = scene["materials"]["soil"];
    scene["materials"]["soil"]["law"]["S"] = S_low;
    scene["materials"]["silt"]["law"]["S"] = S_top;
    json& fem = scene["fem"];
    fem["element"] = "ssp";
    fem["supports"][0]["to"] = {0, 4};
    fem["supports"][1]["to"] = {1, 4};
    fem["crest"] = {1, 4};
    json press = pressed(20);
    press.update({{"type", "dynamic"}, {"name", "press"}, {"duration", 0.05}, {"time_step", 5e-3}});
    if (!S_of_stage.is_null()) press["S"] = S_of_stage;
    fem["stages"] = {static_stage("gravity"), static_stage("law", {{"laws", "scene"}}), press};
    return scene;
}

Eigen::VectorXd end_of(const json& scene) {
    bench::Run run(scene);
    return run.go().motion.u;
}

TEST(SofteningByRegion, IsThatOfAMaterialOfItsOwnToTheLastBit) {
    const Eigen::VectorXd own = end_of(two_soils(0.0, 1.0, nullptr));
    EXPECT_NE(own, end_of(two_soils(1.0, 1.0, nullptr)));
    EXPECT_EQ(own, end_of(two_soils(1.0, 1.0, {{"low", 0}})));
    EXPECT_EQ(own, end_of(two_soils(1.0, 0.0, {{"soil", 0}, {"silt", 1}}))) << "by material";
    EXPECT_EQ(own, end_of(two_soils(0.5, 0.5, {{"soil", 0.5}, {"low", 0}, {"top", 1}})))
        << "a region goes before its material";
    EXPECT_EQ(end_of(two_soils(1.0, 0.0, 0.5)),
              end_of(two_soils(0.0, 1.0, {{"soil", 0.5}, {"silt", 0.5}})));
}

TEST(SofteningByRegion, GoesForDrainedSoilToo) {
    const auto pressed_drained = [](const json& S) {
        json scene = two_soils(1.0, 1.0, nullptr);
        json press = pressed(20);
        press["laws"] = "scene";
        if (!S.is_null()) press["S"] = S;
        scene["fem"]["stages"][2] = static_stage("press", press);
        return end_of(scene);
    };
    EXPECT_EQ(pressed_drained(0.5), pressed_drained({{"low", 0.5}, {"top", 0.5}}));
    EXPECT_EQ(pressed_drained(nullptr), pressed_drained({{"low", 0.0}}));
    EXPECT_NE(pressed_drained(nullptr), pressed_drained({{"low", 0.5}}));
}

TEST(SofteningByRegion, NamesNorSandThatIsThere) {
    EXPECT_EQ(place_refused(two_soils(1.0, 1.0, {{"low", 0}})), "");
    EXPECT_EQ(place_refused(two_soils(1.0, 1.0, {{"clay", 0}})), "/fem/stages/2/S/clay");
    json elastic = two_soils(1.0, 1.0, {{"low", 0}});
    elastic["materials"]["soil"]["law"] = {{"type", "linear_elastic"}, {"E_MPa", 20}, {"nu", 0.3}};
    EXPECT_EQ(place_refused(elastic), "/fem/stages/2/S");
}

}  // namespace
}  // namespace breach::fem::stage_loads_test
