#include "services/templates/templates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "core/check/check.hpp"
#include "core/geometry/polygon.hpp"
#include "core/geometry/polyline.hpp"
#include "tests/folder.hpp"

namespace breach::templates {
namespace {

using mechanics::Vec2;
using nlohmann::json;
using Line = std::vector<Vec2>;
using Numbers = std::function<double(const std::string&)>;

/// The ground from the crest's edge (or the heap's top) to the toe, constructed from the toe by the
/// options alone.
Line asked_ground(const std::string& name, const Numbers& option, bool beach) {
    Line up{Vec2(0.0, 0.0)};
    const auto walk = [&](double across, double rise) {
        if (across > 0.0 || rise > 0.0) up.push_back(up.back() + Vec2(-across, rise));
    };
    const double H = option("height");
    if (name == "upstream_dam") {
        const int raises = static_cast<int>(option("raises"));
        const double starter = raises > 0 ? option("starter_height") : H;
        walk(option("starter_slope") * starter, starter);
        for (int k = 0; k < raises; ++k) {
            const double rise = (H - starter) / raises;
            walk(option("bench_width"), 0.0);
            const double first = option("raise_slope"), last = option("last_raise_slope");
            const double slope = raises > 1 ? first + (last - first) * k / (raises - 1) : first;
            walk(slope * rise, rise);
        }
        walk(option("crest_width"), 0.0);
    } else if (name == "downstream_dam") {
        walk(option("downstream_slope") * H, H);
        walk(option("crest_width"), 0.0);
    } else if (name == "slope") {
        walk(option("face_slope") * H, H);
        walk(option("crest_extent"), 0.0);
    } else {
        const int lifts = static_cast<int>(option("lifts"));
        for (int k = 0; k < lifts; ++k) {
            walk(option("lift_slope") * H / lifts, H / lifts);
            if (k + 1 < lifts) walk(option("bench_width"), 0.0);
        }
        walk(option("top_width"), 0.0);
    }
    if (beach) {
        const double fall = option("freeboard");
        up.push_back(up.back() + Vec2(-option("upstream_slope") * fall, -fall));
        const double far = 1e4;
        up.push_back(up.back() + Vec2(-far, -far * option("beach_slope")));
    }
    std::ranges::reverse(up);
    return up;
}

geometry::Polygon ring_of(const json& polygon) {
    geometry::Polygon ring;
    for (std::size_t i = 0; i + 1 < polygon.size(); ++i)
        ring.emplace_back(polygon[i][0].get<double>(), polygon[i][1].get<double>());
    return ring;
}

double area_below(const Line& ground, double left) {
    double sum = 0.0;
    Line cut{Vec2(left, geometry::straight_level_at(ground, left))};
    for (const Vec2& each : ground)
        if (each.x() > left) cut.push_back(each);
    for (std::size_t i = 1; i < cut.size(); ++i)
        sum += 0.5 * (cut[i].y() + cut[i - 1].y()) * (cut[i].x() - cut[i - 1].x());
    return sum;
}

/// No overlap, no gap, and the requested ground: areas to the millimetres of rounding.
void hold_section(const std::string& name, const Made& made) {
    const json options = made.options;
    const Numbers option = [&](const std::string& key) { return options.at(key).get<double>(); };
    const bool dam = name.ends_with("_dam");
    const Line ground = asked_ground(name, option, dam);
    std::vector<geometry::Polygon> rings;
    double area = 0.0, left = 0.0, highest = 0.0;
    const json scene = made.scene;
    for (const json& each : scene.at("section").at("regions")) {
        const bool is_ground = each.at("name") == "foundation" || each.at("name") == "clay";
        rings.push_back(ring_of(each.at("polygon")));
        EXPECT_FALSE(geometry::defect(rings.back())) << *geometry::defect(rings.back());
        for (const Vec2& vertex : rings.back()) {
            left = std::min(left, vertex.x());
            highest = std::max(highest, vertex.y());
            if (!is_ground) {
                EXPECT_LE(vertex.y(), geometry::straight_level_at(ground, vertex.x()) + 2e-3);
            }
        }
        if (!is_ground) area += geometry::area(rings.back());
    }
    const double length = 1e-3 * (std::abs(left) + highest);
    EXPECT_NEAR(highest, option("height"), 1e-3);
    const double below = dam ? 0.5 * option("valley_slope") * left * left : 0.0;
    EXPECT_NEAR(area, area_below(ground, left) - below, 5.0 * length);
    for (std::size_t i = 0; i < rings.size(); ++i)
        for (std::size_t k = i + 1; k < rings.size(); ++k)
            EXPECT_LT(geometry::overlap_area(rings[i], rings[k]), length);
}

/// Faults of the scene as `breach new` writes it.
std::vector<fault::Fault> faults_of(const Made& made, const std::filesystem::path& folder) {
    if (!made.motion.empty()) std::ofstream(folder / "motion.csv") << made.motion;
    return check::checked_text(as_text(made.scene), "scene.json", folder, {}).faults;
}

std::string listed(const std::vector<fault::Fault>& faults) {
    std::string text;
    for (const fault::Fault& each : faults)
        text += each.pointer + " " + each.cause + ": " + each.remedy + "\n";
    return text;
}

bool can_be_shaken(const Template& each) {
    return std::ranges::find(each.options, "with_fem", &Option::name) != each.options.end();
}

TEST(Templates, DamsCanBeShakenAndNothingElse) {
    for (const Template& each : catalogue())
        EXPECT_EQ(can_be_shaken(each), each.name.ends_with("_dam")) << each.name;
    EXPECT_THROW(make("heap", {{"with_fem", true}}), fault::BadInput);
}

TEST(Templates, DefaultsGiveSoundScenesAtRestAndShaken) {
    const test::Folder folder;
    for (const Template& each : catalogue()) {
        for (const bool shaken : {false, true}) {
            if (shaken && !can_be_shaken(each)) continue;
            const Made made =
                shaken ? make(each.name, {{"with_fem", true}}) : make(each.name, json::object());
            EXPECT_EQ(made.motion.empty(), !shaken);
            EXPECT_EQ(listed(faults_of(made, folder.path())), "") << each.name;
            hold_section(each.name, made);
        }
    }
}

/// Flags of inputs on the unsafe side. The others are those of a grid for a first look, and of free
/// water that does not flow.
bool is_unsafe(const fault::Flag& flag) {
    for (const char* harmless :
         {"coarse_cells", "coarse_elements", "shared_cells", "wide_band", "load_ends"})
        if (flag.code == harmless) return false;
    return true;
}

TEST(Templates, RaiseNoUnsafeWarningAsTheyAre) {
    const test::Folder folder;
    const std::vector<json> options{json::object(),
                                    {{"drain", false}},
                                    {{"drain", true}},
                                    {{"raises", 0}},
                                    {{"raises", 1}, {"height", 20}},
                                    {{"rockfill_starter", true}},
                                    {{"clay_thickness", 2.5}},
                                    {{"slimes_distance", 60}},
                                    {{"foundation_depth", 0}},
                                    {{"valley_slope", 0.03}, {"ground_slope", 0.02}},
                                    {{"with_fem", true}},
                                    {{"with_fem", true}, {"drain", false}},
                                    {{"with_fem", true},
                                     {"height", 20},
                                     {"raises", 1},
                                     {"layer_thickness", 5},
                                     {"cell_size", 2}},
                                    {{"with_fem", true}, {"rockfill_starter", true}},
                                    {{"water_depth", 0}},
                                    {{"water_height", 25}}};
    for (const Template& each : catalogue()) {
        for (const json& of : options) {
            const bool fits = std::ranges::all_of(of.items(), [&](const auto& entry) {
                return std::ranges::find(each.options, entry.key(), &Option::name) !=
                       each.options.end();
            });
            if (!fits) continue;
            SCOPED_TRACE(each.name + " " + of.dump());
            const Made made = make(each.name, of);
            if (!made.motion.empty()) std::ofstream(folder / "motion.csv") << made.motion;
            std::vector<std::vector<std::string>> variants{{}};
            for (const json& variant : json(made.study).value("variants", json::array()))
                if (variant.contains("overrides")) variants.push_back(variant.at("overrides"));
            for (const auto& overrides : variants)
                for (const fault::Flag& flag :
                     check::checked_text(as_text(made.scene), "scene.json", folder.path(),
                                         overrides)
                         .scene.warnings)
                    EXPECT_FALSE(is_unsafe(flag)) << flag.pointer << ": " << flag.message;
        }
    }
}

TEST(Templates, WetFillHasTheFrictionThatPorePressureLeavesInTheRunoutAlone) {
    const json scene = make("upstream_dam", json::object()).scene;
    const json& fill = scene.at("materials").at("starter_dam");
    EXPECT_EQ(fill.at("/limit_strength/phi_deg"_json_pointer), 35.0);
    EXPECT_LT(fill.at("/law/phi_deg"_json_pointer), 32.0);
    EXPECT_LT(fill.at("/law/softening/phi_residual_deg"_json_pointer), 25.0);
    const json drained = make("upstream_dam", {{"drain", true}}).scene;
    EXPECT_FALSE(drained.at("materials").contains("starter_dam"));
    const json shaken = make("upstream_dam", {{"with_fem", true}}).scene;
    EXPECT_EQ(shaken.at("/materials/starter_dam_runout/law/phi_deg"_json_pointer),
              fill.at("/law/phi_deg"_json_pointer));
}

TEST(Templates, HaveAWeakLayerAndAStarterDamOfRockfillWhereTheyAreAskedFor) {
    const test::Folder folder;
    for (const bool shaken : {false, true}) {
        for (const char* name : {"upstream_dam", "downstream_dam"}) {
            json options{
                {"clay_thickness", 2.5}, {"clay_strength", 25}, {"rockfill_starter", true}};
            if (shaken) options["with_fem"] = true;
            const Made made = make(name, options);
            EXPECT_EQ(listed(faults_of(made, folder.path())), "") << name;
            hold_section(name, made);
            const json scene = made.scene;
            EXPECT_EQ(scene.at("/materials/clay/limit_strength/c_kPa"_json_pointer), 25.0);
            const json& regions = scene.at("section").at("regions");
            const auto material = [&](const std::string& region) {
                return std::ranges::find_if(
                           regions, [&](const json& each) { return each.at("name") == region; })
                    ->at("material");
            };
            const json& starter = scene.at("materials").at(material("starter_dam"));
            EXPECT_EQ(starter.at("/limit_strength/phi_deg"_json_pointer), 42.0);
            EXPECT_EQ(material("clay"), "clay");
        }
    }
}

TEST(Templates, FollowTheGroundTheWaterAndTheSlimesOfASite) {
    const test::Folder folder;
    for (const bool shaken : {false, true}) {
        for (const char* name : {"upstream_dam", "downstream_dam"}) {
            SCOPED_TRACE(name);
            json options{
                {"valley_slope", 0.03},  {"ground_slope", 0.02},  {"piezometer_depth", 6},
                {"drain", false},        {"slimes_distance", 60}, {"beach_length", 70},
                {"clay_thickness", 2.5}, {"slimes_ratio", 0.25},  {"residual_ratio", 0.06}};
            if (shaken) options["with_fem"] = true;
            if (name == std::string("upstream_dam")) options["last_raise_slope"] = 4;
            const Made made = make(name, options);
            EXPECT_EQ(listed(faults_of(made, folder.path())), "");
            hold_section(name, made);
            const json scene = made.scene;

            double right_end = 0.0, ground_there = 0.0, first_slimes = -1e9;
            for (const json& each : scene.at("section").at("regions")) {
                for (const json& vertex : each.at("polygon")) {
                    const double x = vertex[0], y = vertex[1];
                    if (each.at("name") == "clay" &&
                        (x > right_end || (x == right_end && y > ground_there)))
                        right_end = x, ground_there = y;
                    if (each.at("name") == "slimes") first_slimes = std::max(first_slimes, x);
                }
            }
            EXPECT_NEAR(ground_there, -0.02 * right_end, 1e-9);
            // The beach meets the dam at the freeboard below the crest's upstream edge.
            const json& line = scene.at("lem").at("water").at("line");
            const auto piezometer = std::ranges::find_if(line, [&](const json& place) {
                return std::abs(place[1].get<double>() - 24.0) < 1e-3;
            });
            ASSERT_NE(piezometer, line.end());
            const double crest_edge = (*piezometer)[0];
            EXPECT_NEAR(first_slimes, crest_edge - 2.0 * 1.5 - 60.0, 2e-3);
            EXPECT_NEAR(line.back()[1].get<double>(), -0.02 * line.back()[0].get<double>(), 1e-3);
            const json& runout = scene.at("materials").at(shaken ? "slimes_runout" : "slimes");
            EXPECT_EQ(runout.at("/strength/peak/ratio"_json_pointer), 0.25);
            EXPECT_EQ(runout.at("/strength/residual/ratio"_json_pointer), 0.06);
            const json& terrain = scene.at("mpm").at("terrain");
            EXPECT_NEAR(terrain.back()[1].get<double>(), -0.02 * terrain.back()[0].get<double>(),
                        1e-6);
        }
    }
}

TEST(Templates, CellsSeeTheWeakLayerAndGroundLiesBelowIt) {
    const auto cell = [](const json& options) {
        return make("upstream_dam", options).scene.at("/mpm/cell_size"_json_pointer).get<double>();
    };
    EXPECT_EQ(cell({{"height", 20}}), 1.0);
    EXPECT_EQ(cell({{"height", 20}, {"clay_thickness", 1.5}}), 0.75);
    EXPECT_EQ(cell({{"height", 20}, {"clay_thickness", 3}}), 1.0);
    EXPECT_EQ(cell({{"height", 20}, {"clay_thickness", 1.5}, {"cell_size", 1.25}}), 1.25);
    EXPECT_EQ(make("upstream_dam", {{"height", 20}, {"clay_thickness", 8}, {"cell_size", 1}})
                  .options.at("foundation_depth"),
              9);
}

TEST(Templates, PeakStrengthIsOfWhatLiquefiesAlone) {
    const Made made = make("upstream_dam", {{"clay_thickness", 2.5}, {"clay_strength", 25}});
    const json overrides = made.study.at("variants")[1].at("overrides");
    const auto starts = [](const std::string& text) {
        return [&text](const json& each) { return each.get<std::string>().starts_with(text); };
    };
    EXPECT_TRUE(std::ranges::any_of(overrides, starts("/materials/tailings_1/law/c_kPa=")));
    EXPECT_FALSE(std::ranges::any_of(overrides, starts("/materials/clay/law")));
    const auto undrained = std::ranges::find_if(overrides, starts("/lem/undrained="));
    ASSERT_NE(undrained, overrides.end());
    EXPECT_EQ(undrained->get<std::string>().find("clay"), std::string::npos) << *undrained;
}

TEST(Templates, ShakenOnesAreTransferredAtSeveralTimes) {
    const Made made = make("upstream_dam", {{"with_fem", true}, {"shaking", 10}});
    EXPECT_EQ(made.study.at("transfer_times").dump(), "[4.0,6.0,8.0,10.0]");
    EXPECT_EQ(made.study.at("triggers").size(), 1u);
}

TEST(Templates, SayWhatIsAssumed) {
    const Made made = make("upstream_dam", {{"name", "ours"}});
    EXPECT_EQ(made.scene.at("name"), "ours");
    EXPECT_EQ(made.study.at("scene"), "scene.json");
    for (const auto& [name, material] : made.scene.at("materials").items())
        EXPECT_NE(material.at("notes").dump().find("assumed"), std::string::npos) << name;
}

TEST(Templates, ALayerHasTheResidualStrengthOfItsStress) {
    const json scene = make("slope", {{"water_depth", 0}, {"residual_ratio", 0.1}}).scene;
    const double first = scene.at("/materials/soil_1/law/c_kPa"_json_pointer);
    // 1.67 m of soil of 1850 kg/m3 below water and, towards the face, under what lies above the
    // line.
    EXPECT_GT(first, 0.1 * 0.5 * 1.667 * 850 * 9.81e-3);
    EXPECT_LT(first, 0.1 * 60.0);
}

/// Random options, most near their defaults and some in their whole range.
json drawn(const Template& of, std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    json options = json::object();
    for (const Option& each : of.options) {
        if (share(random) < 0.5 || each.name == "with_fem") continue;
        double value = each.least + share(random) * (each.most - each.least);
        if (share(random) < 0.8) value = each.value * std::exp(1.2 * (share(random) - 0.5));
        value = std::clamp(value, each.least, each.most);
        if (each.kind == Kind::yes_or_no)
            options[each.name] = share(random) < 0.5;
        else if (each.kind == Kind::whole)
            options[each.name] = static_cast<int>(value);
        else
            options[each.name] = value;
    }
    return options;
}

TEST(Templates, AnyOptionsGiveASoundSceneOrARefusalThatNamesThem) {
    const test::Folder folder;
    std::mt19937 random(19);
    for (const Template& each : catalogue()) {
        int sound = 0, refused = 0;
        for (int k = 0; k < 60; ++k) {
            const json options = drawn(each, random);
            SCOPED_TRACE(each.name + " " + options.dump());
            try {
                const Made made = make(each.name, options);
                EXPECT_EQ(listed(faults_of(made, folder.path())), "");
                hold_section(each.name, made);
                ++sound;
            } catch (const fault::BadInput& refusal) {
                ++refused;
                for (const fault::Fault& fault : refusal.faults()) {
                    const std::string name = fault.pointer.empty() ? "" : fault.pointer.substr(1);
                    EXPECT_NE(std::ranges::find(each.options, name, &Option::name),
                              each.options.end())
                        << listed(refusal.faults());
                    EXPECT_FALSE(fault.cause.empty() || fault.remedy.empty());
                }
            }
        }
        EXPECT_GT(sound, 8) << each.name << ": " << refused << " refused";
    }
}

TEST(Templates, CombinationsThatCloseNothingNameTheOptionToChange) {
    const std::vector<std::tuple<std::string, json, std::string>> cases{
        {"upstream_dam", {{"height", 20}, {"starter_height", 25}}, "/starter_height"},
        {"upstream_dam", {{"bench_width", 12}}, "/bench_width"},
        {"upstream_dam", {{"freeboard", 4}}, "/freeboard"},
        {"upstream_dam", {{"beach_slope", 0.1}, {"beach_length", 400}}, "/beach_slope"},
        {"downstream_dam", {{"beach_slope", 0.1}, {"pond_length", 400}}, "/beach_slope"},
        {"downstream_dam", {{"freeboard", 20}}, "/freeboard"},
        {"slope", {{"water_depth", 12}}, "/water_depth"},
        {"heap", {{"water_height", 31}}, "/water_height"},
        {"upstream_dam", {{"with_fem", true}, {"foundation_depth", 0}}, "/foundation_depth"},
        {"slope", {{"residual_ratio", 0.4}}, "/residual_ratio"},
        {"upstream_dam", {{"cell_size", 4}}, "/cell_size"},
        {"upstream_dam", {{"clay_thickness", 8}, {"foundation_depth", 5}}, "/clay_thickness"},
        {"upstream_dam", {{"valley_slope", 0.15}}, "/valley_slope"},
        {"downstream_dam", {{"valley_slope", 0.2}, {"pond_length", 200}}, "/valley_slope"},
        {"upstream_dam", {{"piezometer_depth", 0.5}}, "/piezometer_depth"},
        {"downstream_dam", {{"piezometer_depth", 40}, {"drain", false}}, "/piezometer_depth"},
        {"upstream_dam", {{"raises", 0}, {"drain", true}, {"piezometer_depth", 5}}, "/drain"},
        {"upstream_dam", {{"slimes_distance", 3000}}, "/slimes_distance"},
    };
    for (const auto& [name, options, pointer] : cases) {
        try {
            make(name, options);
            FAIL() << name << " " << options.dump() << " closes nothing";
        } catch (const fault::BadInput& refusal) {
            EXPECT_EQ(refusal.faults().front().pointer, pointer) << listed(refusal.faults());
            EXPECT_FALSE(refusal.faults().front().remedy.empty());
        }
    }
}

}  // namespace
}  // namespace breach::templates
