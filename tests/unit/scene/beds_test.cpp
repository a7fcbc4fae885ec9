// Beds of firm soil: where they are found, and warnings where they cut cells.
#include "core/scene/beds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace breach {
namespace {

using nlohmann::json;

/// A slope of weak soil on 2 m of firm ground, cells of 1 m from the bottom of the ground.
json slope_on_ground() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "bedded",
        "materials": {
            "weak": {"density": 1850,
                "law": {"type": "mohr_coulomb", "E_MPa": 10, "nu": 0.3, "c_kPa": 6, "phi_deg": 0}},
            "firm": {"density": 2000,
                "law": {"type": "mohr_coulomb", "E_MPa": 60, "nu": 0.3, "c_kPa": 50, "phi_deg": 35}}},
        "section": {"regions": [
            {"name": "ground", "material": "firm", "polygon": [[0,-2],[90,-2],[90,0],[34,0],[0,0],[0,-2]]},
            {"name": "slope", "material": "weak", "polygon": [[0,0],[34,0],[18,8],[0,8],[0,0]]}]},
        "mpm": {"cell_size": 1, "domain_x": [0, 90], "domain_y": [-2, 12], "floor": {"level": -2},
            "fill_points": 3, "duration": 10, "runout": {"toe": [34, 0], "regions": ["slope"]}}})");
}

scene::Scene parsed(const json& document) { return scene::parse_scene(document.dump(), "test"); }

constexpr std::size_t firm = 0, weak = 1;  // materials by name

std::string shared_cells(const json& document) {
    for (const fault::Flag& each : parsed(document).warnings)
        if (each.code == "shared_cells") return each.message;
    return "";
}

TEST(Beds, FirmGroundUnderWeakSoilIsOneAtItsLevel) {
    const scene::Scene scene = parsed(slope_on_ground());
    ASSERT_EQ(scene.materials[firm].name, "firm");
    const std::vector<scene::Bed> beds = scene::beds_of(scene);
    ASSERT_EQ(beds.size(), 1U);
    EXPECT_EQ(beds[0].material, firm);
    EXPECT_EQ(scene.section.regions[beds[0].above].name, "slope");
    EXPECT_EQ(beds[0].level, 0.0);
    EXPECT_EQ(scene::rows_below_bed(scene, firm), 2);
    EXPECT_EQ(scene::rows_below_bed(scene, weak), std::nullopt);
    EXPECT_EQ(shared_cells(slope_on_ground()), "");
}

TEST(Beds, SoilThatIsNoFirmerThanItsCoverIsNone) {
    json document = slope_on_ground();
    document["materials"]["firm"]["law"] = document["materials"]["weak"]["law"];
    document["materials"]["firm"]["law"]["c_kPa"] = 11;  // not twice as strong
    EXPECT_TRUE(scene::beds_of(parsed(document)).empty());
    document["materials"]["firm"]["law"]["c_kPa"] = 13;
    EXPECT_EQ(scene::beds_of(parsed(document)).size(), 1U);
    // The strength after softening counts.
    document["materials"]["firm"]["law"]["softening"] = {{"epsilon_q_start", 0.01},
                                                         {"epsilon_q_end", 0.1},
                                                         {"c_residual_kPa", 4},
                                                         {"phi_residual_deg", 0}};
    EXPECT_TRUE(scene::beds_of(parsed(document)).empty());
}

TEST(Beds, SoilThatCannotFailIsFirm) {
    json document = slope_on_ground();
    document["materials"]["firm"]["law"] = {{"type", "linear_elastic"}, {"E_MPa", 60}, {"nu", 0.3}};
    EXPECT_EQ(scene::rows_below_bed(parsed(document), firm), 2);
}

TEST(Beds, StrengthsByPlaceCountAsTheyAreThere) {
    json document = slope_on_ground();
    document["materials"]["weak"]["law"] = {{"type", "mohr_coulomb"}, {"E_MPa", 10}, {"nu", 0.3}};
    document["materials"]["weak"]["strength"] = {
        {"peak", {{"type", "undrained_ratio"}, {"ratio", 0.05}, {"minimum_kPa", 0.5}}}};
    EXPECT_EQ(scene::beds_of(parsed(document)).size(), 1U);
}

TEST(Beds, AnEdgeWithinACellIsReportedWithCellsThatFit) {
    json document = slope_on_ground();
    document["mpm"]["cell_size"] = 1.5;
    document["mpm"]["domain_y"] = {-2, 13};
    EXPECT_EQ(scene::rows_below_bed(parsed(document), firm), std::nullopt);
    const std::string told = shared_cells(document);
    EXPECT_NE(told.find("\"ground\" lies at 0 m, 0.333 of a cell above a line"), std::string::npos)
        << told;
    EXPECT_NE(told.find("--set /mpm/cell_size=1 or --set /mpm/cell_size=2"), std::string::npos)
        << told;
}

TEST(Beds, OnTerrainTheReportNamesAFloorThatFits) {
    json document = slope_on_ground();
    document["mpm"]["cell_size"] = 1.5;
    document["mpm"]["domain_y"] = {-5, 13};
    document["mpm"]["floor"]["level"] = -5;
    document["mpm"]["terrain"] = json::parse("[[0,-2],[90,-2]]");
    const std::string told = shared_cells(document);
    EXPECT_NE(told.find("--set /mpm/floor/level=-6 --set '/mpm/domain_y=[-6,13]'"),
              std::string::npos)
        << told;
    document["mpm"]["floor"]["level"] = -6;
    document["mpm"]["domain_y"] = {-6, 13};
    EXPECT_EQ(shared_cells(document), "");
    EXPECT_EQ(scene::rows_below_bed(parsed(document), firm), 4);
}

TEST(Beds, ATopThatSlopesIsReported) {
    json document = slope_on_ground();
    document["section"]["regions"][0]["polygon"] =
        json::parse("[[0,-2],[90,-2],[90,-1],[34,0],[0,1],[0,-2]]");
    document["section"]["regions"][1]["polygon"] = json::parse("[[0,1],[34,0],[18,8],[0,8],[0,1]]");
    EXPECT_NE(shared_cells(document).find("/mpm/terrain"), std::string::npos);
}

TEST(Beds, AMaterialThatAlsoLiesHigherIsReported) {
    json document = slope_on_ground();
    document["section"]["regions"].push_back(
        {{"name", "knoll"},
         {"material", "firm"},
         {"polygon", json::parse("[[60,0],[90,0],[90,3],[70,3],[60,0]]")}});
    EXPECT_EQ(scene::rows_below_bed(parsed(document), firm), std::nullopt);
    EXPECT_NE(shared_cells(document).find("material of its own"), std::string::npos);
}

TEST(Beds, WhatMovesItselfIsNotWarnedOf) {
    json document = slope_on_ground();
    document["mpm"]["cell_size"] = 1.5;
    document["mpm"]["domain_y"] = {-2, 13};
    document["mpm"]["allow_coarse_cells"] = true;
    document["mpm"]["runout"]["regions"] = {"slope", "ground"};
    EXPECT_EQ(shared_cells(document), "");
}

}  // namespace
}  // namespace breach
