// Entries of a scene about terrain, gauges and the stress of filled points.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/scene/scene.hpp"

namespace breach {
namespace {

using nlohmann::json;

json column() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "column",
        "materials": {"sand": {"density": 1800,
            "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 30}}},
        "section": {"regions": [{"name": "column", "material": "sand",
            "polygon": [[0,0],[10,0],[10,20],[0,20],[0,0]]}]},
        "mpm": {"cell_size": 1, "domain_x": [0, 60], "domain_y": [-2, 22], "floor": {"level": -2},
            "duration": 10, "runout": {"toe": [10, 0]}}})");
}

std::set<std::string> faults_of_mpm(const char* key, const char* value) {
    json document = column();
    document["mpm"][key] = json::parse(value);
    std::set<std::string> pointers;
    try {
        scene::parse_scene(document.dump(), "test");
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults()) pointers.insert(each.pointer);
    }
    return pointers;
}

/// From 20 m to the floor at -2 m.
TEST(MpmScene, SoilThatYieldsIsAsStiffAsItsFallNeeds) {
    const auto limit = [](const std::vector<std::string>& overrides) {
        return scene::parse_scene(column().dump(), "test", ".", overrides).mpm->wave_speed_limit;
    };
    EXPECT_NEAR(limit({}).value(), 10.0 * std::sqrt(2.0 * 9.81 * 22.0), 1e-9);
    EXPECT_NEAR(limit({"/mpm/terrain=[[-1,0],[61,0]]"}).value(),
                10.0 * std::sqrt(2.0 * 9.81 * 20.0), 1e-9);
    EXPECT_FALSE(limit({"/mpm/stiffness_scale=1"}));
    EXPECT_FALSE(limit({"/mpm/time_step=1e-4"}));
    EXPECT_FALSE(limit({"/gravity=0"}));
    EXPECT_FALSE(limit({R"(/materials/sand/law={"type":"linear_elastic","E_MPa":20,"nu":0.3})"}));
}

using Range = std::array<double, 2>;

TEST(MpmScene, TheGridGrowsToWholeCellsAwayFromItsLeftEndAndTheFloor) {
    const auto grid = [](const std::vector<std::string>& overrides) {
        return *scene::parse_scene(column().dump(), "test", ".", overrides).mpm;
    };
    const std::string zones =
        R"(/mpm/floor/friction=[{"from":0,"to":30,"coefficient":1},{"from":30,"to":60,"coefficient":0}])";
    const scene::Mpm grown = grid({"/mpm/cell_size=0.7", "/mpm/domain_y=[-3,22]", zones});
    EXPECT_DOUBLE_EQ(grown.domain_x[0], 0.0);
    EXPECT_DOUBLE_EQ(grown.domain_x[1], 86 * 0.7);
    EXPECT_DOUBLE_EQ(grown.domain_y[0], -2.0 - 2 * 0.7);
    EXPECT_DOUBLE_EQ(grown.domain_y[1], -2.0 + 35 * 0.7);
    EXPECT_EQ(grown.floor.level, -2.0);
    EXPECT_EQ(grown.floor.friction[0].to, 30.0);
    EXPECT_EQ(grown.floor.friction[1].to, grown.domain_x[1]) << "no smooth strip at the end";

    for (const char* size : {"1", "0.1", "0.3", "0.625"}) {  // whole, up to round-off: untouched
        const scene::Mpm whole =
            grid({std::string("/mpm/cell_size=") + size, "/mpm/domain_y=[-2,13]",
                  "/mpm/runout/toe=[10,0]",
                  "/section/regions/0/polygon=[[0,0],[10,0],[10,9],[0,9],[0,0]]"});
        EXPECT_EQ(whole.domain_x, (Range{0.0, 60.0})) << size;
        EXPECT_EQ(whole.domain_y, (Range{-2.0, 13.0})) << size;
    }
    EXPECT_EQ(grid({"/mpm/domain_x=[0,60.00000006]"}).domain_x[1], 60.00000006);
}

TEST(MpmScene, TerrainGaugesAndFillStressAreRead) {
    json document = column();
    document["mpm"]["terrain"] = json::parse("[[0, 0], [20, 0], [60, -1]]");
    document["mpm"]["gauges"] = json::parse(
        R"([{"name": "road", "x": 30}, {"name": "house", "x": 40, "arrival_depth": 1}])");
    document["mpm"]["fill_stress"] = "overburden";
    document["mpm"]["runout"]["front_depth"] = 0.3;
    const scene::Mpm mpm = *scene::parse_scene(document.dump(), "test").mpm;
    ASSERT_EQ(mpm.terrain.size(), 3U);
    EXPECT_EQ(mpm.terrain[2].y(), -1.0);
    ASSERT_EQ(mpm.gauges.size(), 2U);
    EXPECT_EQ(mpm.gauges[0].name, "road");
    EXPECT_EQ(mpm.gauges[0].arrival_depth, 0.5);
    EXPECT_EQ(mpm.gauges[1].arrival_depth, 1.0);
    EXPECT_EQ(mpm.fill_stress, scene::FillStress::overburden);
    EXPECT_EQ(mpm.runout.front_depth, 0.3);
}

TEST(MpmScene, WithoutThemThereIsNoneOfThem) {
    const scene::Mpm mpm = *scene::parse_scene(column().dump(), "test").mpm;
    EXPECT_TRUE(mpm.terrain.empty());
    EXPECT_TRUE(mpm.gauges.empty());
    EXPECT_EQ(mpm.fill_stress, scene::FillStress::none);
    EXPECT_EQ(mpm.runout.front_depth, 1.0);
}

TEST(MpmScene, GapsAreHeldToTheirRoomOnSteepGroundOrWhereAsked) {
    const auto holds = [](const char* terrain, const json& asked) {
        json document = column();
        document["mpm"]["terrain"] = json::parse(terrain);
        if (!asked.is_null()) document["mpm"]["gap_room"] = asked;
        return scene::parse_scene(document.dump(), "test").mpm->gap_room;
    };
    EXPECT_FALSE(scene::parse_scene(column().dump(), "test").mpm->gap_room);
    EXPECT_FALSE(holds("[[0, 0], [20, 11]]", nullptr));
    EXPECT_TRUE(holds("[[0, 12], [20, 0], [60, 0]]", nullptr));
    EXPECT_FALSE(holds("[[0, 0], [20, 0], [21, 4]]", nullptr)) << "a step is no valley";
    EXPECT_FALSE(holds("[[0, 12], [20, 0], [60, 0]]", false));
    EXPECT_TRUE(holds("[[0, 0], [20, 11]]", true));
}

TEST(MpmScene, RefusesTerrainAndGaugesThatCannotBe) {
    using Set = std::set<std::string>;
    EXPECT_EQ(faults_of_mpm("terrain", "[[0, 0], [0, -1]]"), Set{"/mpm/terrain/1"});
    EXPECT_EQ(faults_of_mpm("terrain", "[[0, 0], [60, -1.5]]"), Set{"/mpm/terrain/1"});
    EXPECT_EQ(faults_of_mpm("terrain", "[[0, 22], [60, 0]]"), Set{"/mpm/terrain/0"});
    EXPECT_EQ(faults_of_mpm("terrain", "[[0, 12], [20, 0]]"), Set{"/mpm/terrain"})
        << "it goes on below the floor";
    EXPECT_EQ(faults_of_mpm("gauges", R"([{"name": "a", "x": 61}])"), Set{"/mpm/gauges/0/x"});
    EXPECT_EQ(faults_of_mpm("gauges", R"([{"name": "a", "x": 1}, {"name": "a", "x": 2}])"),
              Set{"/mpm/gauges/1/name"});
    EXPECT_EQ(faults_of_mpm("gauges", R"([{"name": "a b", "x": 1}])"), Set{"/mpm/gauges/0/name"});
}

TEST(MpmScene, StandingWaterLiesInTheGridOverSoilAndBelowTheCrest) {
    using Set = std::set<std::string>;
    const auto of = [](const char* line) {
        return faults_of_mpm("water", (R"({"line": )" + std::string(line) + "}").c_str());
    };
    EXPECT_EQ(of("[[0, 15]]"), Set{});
    EXPECT_EQ(of("[[0, 19], [10, 3], [60, 0]]"), Set{});
    EXPECT_EQ(of("[[0, 20]]"), Set{"/mpm/water/line"}) << "at the crest";
    EXPECT_EQ(of("[[0, 30]]"), Set{"/mpm/water/line"}) << "above the grid";
    EXPECT_EQ(of("[[70, 10], [80, 5]]"), Set{"/mpm/water/line"}) << "beside the grid";
    EXPECT_EQ(of("[[0, -1], [60, -1]]"), Set{"/mpm/water/line"}) << "below all soil";
    EXPECT_EQ(faults_of_mpm("water", R"({"line": [[0, 15]], "density": 0})"),
              Set{"/mpm/water/density"});
    EXPECT_EQ(faults_of_mpm("water", "{}"), Set{"/mpm/water"}) << "without a line";
}

TEST(MpmScene, SectionsEnvelopeAndBreachWidthAreRead) {
    json document = column();
    document["mpm"]["sections"] = json::parse(R"([{"name": "toe", "x": 10}])");
    document["mpm"]["breach_width"] = 72;
    scene::Mpm mpm = *scene::parse_scene(document.dump(), "test").mpm;
    ASSERT_EQ(mpm.sections.size(), 1U);
    EXPECT_EQ(mpm.sections[0].x, 10.0);
    EXPECT_EQ(mpm.arrival_depth, 0.1);
    EXPECT_EQ(mpm.breach_width->low, 72.0);
    document["mpm"]["breach_width"] = json::parse("[60, 72, 90]");
    document["mpm"]["envelope"] = json::parse(R"({"arrival_depth": 0.3})");
    mpm = *scene::parse_scene(document.dump(), "test").mpm;
    EXPECT_EQ(mpm.breach_width->high, 90.0);
    EXPECT_EQ(mpm.arrival_depth, 0.3);
}

TEST(MpmScene, RefusesSectionsAndBreachWidthsThatCannotBe) {
    using Set = std::set<std::string>;
    EXPECT_EQ(faults_of_mpm("sections", R"([{"name": "a", "x": 61}])"), Set{"/mpm/sections/0/x"});
    EXPECT_EQ(faults_of_mpm("sections", R"([{"name": "a", "x": 1}, {"name": "a", "x": 2}])"),
              Set{"/mpm/sections/1/name"});
    EXPECT_EQ(faults_of_mpm("breach_width", "[80, 72, 90]"), Set{"/mpm/breach_width"});
    EXPECT_EQ(faults_of_mpm("breach_width", "0"), Set{"/mpm/breach_width"});
    EXPECT_EQ(faults_of_mpm("breach_width", "[72, 90]"), Set{"/mpm/breach_width"});
    EXPECT_EQ(faults_of_mpm("envelope", R"({"arrival_depth": 0})"),
              Set{"/mpm/envelope/arrival_depth"});
}

}  // namespace
}  // namespace breach
