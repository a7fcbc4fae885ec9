// A drawn section under an earthquake: the FEM part of the scene, or why there is none.
#include <gtest/gtest.h>

#include <fstream>

#include "core/check/check.hpp"
#include "drawings.hpp"
#include "tests/folder.hpp"

namespace breach::importing::shake_test {
namespace {

using nlohmann::json;
using test::dxf;
using test::light;
using test::Line;

const std::string water = light("PHREATIC", {{0, 9}, {40, 8}, {75, 1}, {120, -0.5}}, false);

Request shaken(const Line& rock = test::rock) {
    Request request = test::request(dxf(light("ROCK", rock) + light("CLAY", test::clay) +
                                        light("TAILINGS", test::tailings) + water));
    request.layers = {"TAILINGS=4,8"};
    request.motion.emplace();
    return request;
}

std::string faults_of(const Request& request) { return test::told(import_section(request).faults); }

/// Faults when a phase reads the files of `breach import`.
std::string faults_of_files(const Imported& imported) {
    const breach::test::Folder folder;
    std::ofstream(folder.path() / "motion.csv") << imported.motion;
    return test::told(
        check::checked_text(imported.scene.dump(), "scene.json", folder.path(), {}).faults);
}

TEST(ShakenImport, HasTheFemTheTransferAndTheStudyOfATemplate) {
    const Imported imported = import_section(shaken());
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(faults_of_files(imported), "");
    const json& fem = imported.scene.at("fem");
    EXPECT_EQ(fem.at("damping"), json::parse(R"({"ratio": 0.005, "frequency_Hz": 3})"));
    EXPECT_EQ(fem.at("supports")[0].at("from"), json::parse("[0.0, -10.0]"));
    EXPECT_EQ(fem.at("supports")[0].at("to"), json::parse("[120.0, -10.0]"));
    EXPECT_FALSE(fem.at("free_field").contains("sides")) << "both sides are vertical";
    EXPECT_EQ(fem.at("crest"), json::parse("[55.0, 12.0]"));
    EXPECT_EQ(imported.scene.at("lem").at("liquefaction")[0].at("region"), "TAILINGS_0_4");
    EXPECT_EQ(imported.scene.at("transfer").at("liquefied").at("regions").size(), 3u);
    EXPECT_FALSE(imported.scene.at("mpm").contains("fill_stress"));
    EXPECT_LT(imported.scene.at("mpm").at("domain_x")[0], 0.0) << "room for the side that sways";
    EXPECT_EQ(imported.study.at("transfer_times"), json::parse("[3.2, 4.8, 6.4, 8.0]"));
    EXPECT_TRUE(imported.motion.starts_with("# Synthetic"));
}

TEST(ShakenImport, CompletesTheMaterialsAndKeepsWhatIsGiven) {
    Request request = shaken();
    request.materials["clay"]["void_ratio"] = 0.66;
    const json given = request.materials;
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    const json& materials = imported.scene.at("materials");
    EXPECT_EQ(materials.at("tailings").at("law").at("D_R"), 0.35) << "loose: it is cut in layers";
    EXPECT_EQ(materials.at("clay").at("law").at("D_R"), 0.55);
    EXPECT_EQ(materials.at("rock").at("law").at("D_R"), 0.75) << "it lies below the toe";
    EXPECT_EQ(materials.at("clay").at("void_ratio"), 0.66);
    EXPECT_EQ(materials.at("tailings_runout"), given.at("tailings"));
    EXPECT_EQ(materials.at("tailings").at("density"), given.at("tailings").at("density"));
    // A completed section is not completed again.
    request.materials = materials;
    request.materials["tailings"]["law"]["D_R"] = 0.41;
    const Imported again = import_section(request);
    ASSERT_EQ(test::told(again.faults), "");
    EXPECT_EQ(again.scene.at("materials"), request.materials);
    EXPECT_EQ(again.scene.at("transfer"), imported.scene.at("transfer"));
}

TEST(ShakenImport, UndrainedSoilBesideTheTailingsStaysUndrained) {
    Request request = shaken();
    request.materials["clay"]["law"]["phi_deg"] = 0;
    request.materials["clay"]["law"]["c_kPa"] = 40;
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(imported.scene.at("materials").at("clay").at("law").at("type"), "mohr_coulomb");
    EXPECT_FALSE(imported.scene.at("materials").contains("clay_runout"));
    request.map = {"TAILINGS=clay"};
    EXPECT_NE(faults_of(request).find("/materials/clay: is not drained soil, and region "
                                      "TAILINGS_0_4 is to liquefy"),
              std::string::npos)
        << faults_of(request);
}

TEST(ShakenImport, EdgesThatAreLevelOrVerticalWithinTheToleranceBecomeSo) {
    const Imported imported =
        import_section(shaken({{0, -10}, {60, -9.97}, {120.02, -9.98}, {120, 0}, {0, 0}}));
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(faults_of_files(imported), "");
    EXPECT_EQ(imported.scene.at("fem").at("supports")[0].at("to"), json::parse("[120.02, -10.0]"));
    EXPECT_FALSE(imported.scene.at("fem").at("free_field").contains("sides"));
}

TEST(ShakenImport, ASideWhereTheGroundComesDownToTheBaseHasNoColumn) {
    Request request =
        test::request(dxf(light("CLAY", test::clay) + light("TAILINGS", test::tailings) +
                          light("PHREATIC", {{0, 9}, {40, 8}, {80, 0}}, false)));
    request.layers = {"TAILINGS=4"};
    request.motion.emplace();
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(faults_of_files(imported), "");
    EXPECT_EQ(imported.scene.at("fem").at("free_field").at("sides"), "left");
    EXPECT_NE(imported.report.at("remarks").dump().find("no free-field column on the right"),
              std::string::npos);
}

TEST(ShakenImport, WhatTheFemCannotShakeIsRefusedWithItsPlaceAndARemedy) {
    const std::string sloped =
        faults_of(shaken({{0, -10}, {60, -10}, {120, -6}, {120, 0}, {0, 0}}));
    EXPECT_NE(sloped.find("the lower edge is not level: ROCK ends at ("), std::string::npos)
        << sloped;
    EXPECT_NE(sloped.find("draw the ground down to ("), std::string::npos) << sloped;
    const std::string leaning = faults_of(shaken({{0, -10}, {115, -10}, {120, 0}, {0, 0}}));
    EXPECT_NE(leaning.find("the right side is not vertical: the section ends at (120, 0)"),
              std::string::npos)
        << leaning;
    Request request = shaken();
    request.layers = {};
    EXPECT_NE(faults_of(request).find("layers: no region is cut in layers"), std::string::npos)
        << faults_of(request);
    request.drawing.bytes = dxf(light("ROCK", test::rock) + light("CLAY", test::clay));
    EXPECT_NE(faults_of(request).find("phreatic: is missing"), std::string::npos);
    request = shaken();
    request.motion->pga = 3;
    request.motion->shaking = 1;
    EXPECT_EQ(faults_of(request),
              "pga: is 3 g | give 0.01 to 1.5 g\nshaking: is 1 s | give 4 to 60 s\n");
    request = shaken();
    request.materials["tailings"].erase("density");
    EXPECT_NE(faults_of(request).find("/materials/tailings"), std::string::npos)
        << faults_of(request);
}

TEST(ShakenImport, ASlopeToTheLeftIsRefused) {
    const auto mirrored = [](Line ring) {
        for (mechanics::Vec2& each : ring) each.x() = -each.x();
        return ring;
    };
    Request request = shaken();
    request.drawing.bytes =
        dxf(light("ROCK", mirrored(test::rock)) + light("CLAY", mirrored(test::clay)) +
            light("TAILINGS", mirrored(test::tailings)) +
            light("PHREATIC", {{-120, -0.5}, {-75, 1}, {-40, 8}, {0, 9}}, false));
    EXPECT_NE(faults_of(request).find("mirror the drawing"), std::string::npos)
        << faults_of(request);
}

}  // namespace
}  // namespace breach::importing::shake_test
