#include "core/scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "core/scene/schema.hpp"

namespace {

using namespace breach;
using nlohmann::json;

const std::filesystem::path scenes = std::filesystem::path(BREACH_ROOT) / "workflows/scenes";

json column() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "column",
        "materials": {"sand": {"density": 1800,
            "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 30}}},
        "section": {"regions": [{"name": "column", "material": "sand",
            "polygon": [[0,0],[10,0],[10,20],[0,20],[0,0]], "mesh": {"type": "block", "divisions": [10, 20]}}]},
        "fem": {"supports": [{"name": "base", "from": [0,0], "to": [10,0], "fixes": "xy"}],
            "stages": [{"type": "dynamic", "name": "fall", "duration": 1, "time_step": 0.01}], "crest": [10, 20]},
        "mpm": {"cell_size": 1, "domain_x": [0, 60], "domain_y": [0, 22], "floor": {"level": 0},
            "duration": 10, "runout": {"toe": [10, 0]}}})");
}

std::set<std::string> fault_pointers(const json& document) {
    try {
        scene::parse_scene(document.dump(), "test");
    } catch (const fault::BadInput& error) {
        std::set<std::string> pointers;
        for (const fault::Fault& each : error.faults()) {
            EXPECT_FALSE(each.cause.empty());
            EXPECT_FALSE(each.remedy.empty()) << each.pointer << " " << each.cause;
            pointers.insert(each.pointer);
        }
        return pointers;
    }
    return {};
}

TEST(Scene, ConvertsUnitsOnce) {
    const scene::Scene read = scene::parse_scene(column().dump(), "test");
    const auto& law = std::get<materials::MohrCoulomb>(read.materials.at(0).law);
    EXPECT_DOUBLE_EQ(law.elasticity.E, 20e6);
    EXPECT_DOUBLE_EQ(law.c, 1e3);
    EXPECT_DOUBLE_EQ(law.phi, std::numbers::pi / 6.0);
    EXPECT_DOUBLE_EQ(read.gravity, 9.81);
}

TEST(Scene, CompletedSceneReadsBackToItself) {
    const std::string completed = scene::parse_scene(column().dump(), "test").completed;
    EXPECT_EQ(scene::parse_scene(completed, "again").completed, completed);
    EXPECT_TRUE(json::parse(completed).at("mpm").contains("cfl"));
}

TEST(Scene, EqualNumbersMakeEqualScenes) {
    json with_points = column(), without = column();
    with_points["gravity"] = 10.0;
    with_points["materials"]["sand"]["density"] = 1.8e3;
    without["gravity"] = 10;
    without["materials"]["sand"]["density"] = 1800;
    ASSERT_NE(with_points.dump(), without.dump());
    const scene::Scene one = scene::parse_scene(with_points.dump(), "test", {}, {"/mpm/cfl=0.50"});
    const scene::Scene other = scene::parse_scene(without.dump(), "test", {}, {"/mpm/cfl=0.5"});
    EXPECT_EQ(one.completed, other.completed);
    EXPECT_EQ(one.gravity, 10.0);
    EXPECT_EQ(json::parse(one.completed).at("mpm").at("cfl"), 0.5);
}

TEST(Scene, ShippedScenesAreSound) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        EXPECT_NO_THROW(scene::read_scene(entry.path())) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 2);
}

TEST(Scene, NamesAllFaultsOfOneBadSceneTogether) {
    json bad = column();
    bad["materials"]["sand"]["density"] = -1800;
    bad["materials"]["sand"]["law"]["nu"] = 0.5;
    bad["section"]["regions"][0]["polygon"].erase(4);  // open ring
    bad["section"]["regions"][0]["material"] = "sandd";
    bad["mpm"]["cell_sise"] = 2;
    const std::set<std::string> expected{"/materials/sand/density", "/materials/sand/law/nu",
                                         "/section/regions/0/polygon",
                                         "/section/regions/0/material", "/mpm/cell_sise"};
    EXPECT_EQ(fault_pointers(bad), expected);
}

TEST(Scene, AMeshWithoutAPolygonIsAFaultOfThePolygon) {
    for (const char* polygon : {"", "false", "[[0, 0], 1]"}) {
        json document = column();
        json& region = document["section"]["regions"][0];
        region.erase("polygon");
        if (*polygon != 0) region["polygon"] = json::parse(polygon);
        const auto pointers = fault_pointers(document);
        EXPECT_TRUE(std::ranges::any_of(pointers, [](const std::string& pointer) {
            return pointer.starts_with("/section/regions/0");
        })) << polygon;
    }
}

TEST(Scene, RefusesWhatTheSchemaCannotSee) {
    const std::vector<std::pair<std::string, json>> cases{
        {"/materials/sand/law/psi_deg", 31},
        {"/materials/sand/law/softening/epsilon_q_end", json{{"epsilon_q_start", 0.1},
                                                             {"epsilon_q_end", 0.05},
                                                             {"c_residual_kPa", 0},
                                                             {"phi_residual_deg", 0}}},
        {"/section/regions/0/polygon", json::parse("[[0,0],[10,20],[10,0],[0,20],[0,0]]")},
        {"/fem/newmark_beta", 0.25},
        {"/fem/snapshot_times", json::parse("[0.5, 2.0]")},
        {"/fem/snapshot_times/1", json::parse("[0.5, 0.2]")},
        {"/mpm/domain_y", json::parse("[10, 0]")},
        {"/mpm/floor/level", -0.5},
        {"/mpm/runout/regions/0", json::parse("[\"dam\"]")},
    };
    for (const auto& [pointer, value] : cases) {
        json bad = column();
        std::string target = pointer;
        if (value.is_object() || (value.is_array() && std::isdigit(pointer.back()))) {
            target = pointer.substr(0, pointer.rfind('/'));
        }
        bad[json::json_pointer(target)] = value;
        EXPECT_TRUE(fault_pointers(bad).count(pointer)) << pointer;
    }
}

TEST(Scene, RefusesRegionsThatOverlap) {
    json bad = column();
    json second = bad["section"]["regions"][0];
    second["name"] = "second";
    bad["section"]["regions"].push_back(second);
    EXPECT_EQ(fault_pointers(bad), std::set<std::string>{"/section/regions/1/polygon"});
}

TEST(Scene, TakesClockwiseRingsAndKeepsTheMeaningOfDivisions) {
    json document = column();
    document["section"]["regions"][0]["polygon"] =
        json::parse("[[0,0],[0,20],[10,20],[10,0],[0,0]]");
    document["section"]["regions"][0]["mesh"]["divisions"] = json::parse("[20, 10]");
    const scene::Region region = scene::parse_scene(document.dump(), "test").section.regions.at(0);
    EXPECT_GT(geometry::signed_area(region.polygon), 0.0);
    const auto side = [&](int k) {
        return (region.polygon[region.corners[k + 1]] - region.polygon[region.corners[k]]).norm();
    };
    EXPECT_DOUBLE_EQ(side(0), 20.0);  // the author's first edge goes up 20 m and has 20 elements
    EXPECT_DOUBLE_EQ(side(1), 10.0);
    EXPECT_EQ(region.divisions[0], 20);
}

TEST(Scene, OverridesAreCheckedLikeTheFile) {
    const std::string text = column().dump();
    EXPECT_DOUBLE_EQ(scene::parse_scene(text, "t", ".", {"/gravity=1.62"}).gravity, 1.62);
    EXPECT_THROW(scene::parse_scene(text, "t", ".", {"/gravity=-1"}), fault::BadInput);
    EXPECT_THROW(scene::parse_scene(text, "t", ".", {"/gravty=1"}), fault::BadInput);
}

TEST(Scene, SaysWhichPartAPhaseLacks) {
    const scene::Scene read = scene::parse_scene(column().dump(), "test");
    EXPECT_NO_THROW(scene::mpm_of(read));
    EXPECT_THROW(scene::lem_of(read), fault::BadInput);
}

TEST(Scene, MissingFileIsAnIoFault) {
    EXPECT_THROW(scene::read_scene("/no/such/scene.json"), fault::IoError);
    EXPECT_THROW(scene::read_scene("/"), fault::IoError);
}

// Replaces each entry of a valid scene by values of every kind: the reader must refuse or accept,
// never crash.
TEST(Scene, SurvivesEveryWrongValueAnywhere) {
    const json sound = column();
    const std::vector<json> values{nullptr,
                                   true,
                                   -1,
                                   0,
                                   1e300,
                                   "",
                                   "x",
                                   json::array(),
                                   json::object(),
                                   json::parse("[[1]]"),
                                   json::parse("{\"type\": 3}")};
    const json flat = sound.flatten();
    int refused = 0;
    for (const auto& [pointer, leaf] : flat.items()) {
        for (std::string at = pointer; !at.empty(); at = at.substr(0, at.rfind('/'))) {
            for (const json& value : values) {
                json mutated = sound;
                mutated[json::json_pointer(at)] = value;
                try {
                    scene::parse_scene(mutated.dump(), "mutated");
                } catch (const fault::BadInput&) {
                    ++refused;
                }
            }
        }
    }
    EXPECT_GT(refused, 500);
}

}  // namespace
