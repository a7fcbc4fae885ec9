// A drawn section that liquefies at rest: the scene and the study, or why there is none.
#include <gtest/gtest.h>

#include "core/check/check.hpp"
#include "drawings.hpp"

namespace breach::importing::liquefy_test {
namespace {

using nlohmann::json;
using test::dxf;
using test::light;
using test::Line;

const Line water{{0, 9}, {40, 8}, {75, 1}, {120, -0.5}};
const Line ponded{{0, 11.6}, {20, 11.6}, {75, 1}, {120, -0.5}};

Request liquefied(const std::string& entry, const Line& line = water,
                  const std::string& more = "") {
    Request request = test::request(dxf(light("ROCK", test::rock) + light("CLAY", test::clay) +
                                        light("TAILINGS", test::tailings) +
                                        light("PHREATIC", line, false) + more));
    request.liquefied = {entry};
    return request;
}

Imported imported(const Request& request) {
    Imported made = import_section(request);
    EXPECT_EQ(test::told(made.faults), "");
    return made;
}

/// Faults and warnings of the scene with a variant's overrides, as a phase reads it.
std::string judged(const Imported& made, const std::string& variant) {
    for (const json& each : made.study.at("variants")) {
        if (each.at("name") != variant) continue;
        const check::Checked read =
            check::checked_text(made.scene.dump(), "scene.json", ".", each.at("overrides"));
        std::string all = test::told(read.faults);
        for (const fault::Flag& flag : read.scene.warnings) all += flag.code + "\n";
        return all;
    }
    return "no variant " + variant;
}

json region(const json& scene, const std::string& name) {
    for (const json& each : scene.at("section").at("regions"))
        if (each.at("name") == name) return each;
    return nullptr;
}

std::string remarks_of(const Imported& made) { return made.report.at("remarks").dump(); }

TEST(LiquefiedImport, OnlyTheWetPartHasTheResidualStrengthAndKeepsItsDrainedOneBefore) {
    const Imported made = imported(liquefied("tailings=0.08,CPTu 2024, table 3"));
    EXPECT_EQ(region(made.scene, "TAILINGS_above").at("material"), "tailings");
    EXPECT_EQ(region(made.scene, "TAILINGS_below").at("material"), "tailings_liquefied");
    const json& soil = made.scene.at("materials").at("tailings_liquefied");
    const json ratio =
        json::parse(R"({"type": "undrained_ratio", "ratio": 0.08, "minimum_kPa": 1})");
    EXPECT_EQ(soil.at("strength").at("residual"), ratio);
    EXPECT_EQ(soil.at("limit_strength"), json::parse(R"({"c_kPa": 2.0, "phi_deg": 30.0})"));
    EXPECT_NE(soil.at("notes").dump().find("(as in \\\"breach new\\\"): CPTu 2024, table 3"),
              std::string::npos);
    EXPECT_EQ(made.scene.at("lem").at("liquefaction"),
              json::parse(R"([{"region": "TAILINGS_below"}])"));
    EXPECT_EQ(made.study.at("variants").size(), 2u);
    EXPECT_NE(remarks_of(made).find("peak 0.27 sigma'_v0 (as in \\\"breach new\\\")"),
              std::string::npos);
}

TEST(LiquefiedImport, EveryVariantIsReadWithoutAFaultAndWarnsOfNothingButTheCellSize) {
    for (const char* entry : {"TAILINGS=0.08,CPTu", "TAILINGS=6kPa,20kPa,vane"}) {
        const Imported made = imported(liquefied(entry, ponded));
        EXPECT_EQ(made.study.at("variants").size(), 4u);
        for (const char* variant :
             {"liquefied", "undrained_peak", "liquefied_no_pond", "undrained_peak_no_pond"})
            EXPECT_EQ(judged(made, variant), "coarse_cells\n") << entry << " " << variant;
        EXPECT_EQ(remarks_of(made).find("cell_size"), std::string::npos) << remarks_of(made);
    }
}

TEST(LiquefiedImport, TwoVariantsAreWithoutTheDrawnPond) {
    const Imported made = imported(liquefied("TAILINGS=0.08,CPTu", ponded));
    EXPECT_FALSE(made.scene.at("mpm").contains("water")) << "it would hold the scarp back";
    EXPECT_EQ(made.scene.at("lem").at("water").at("line")[0], json::parse("[0.0, 11.6]"));
    const json& variants = made.study.at("variants");
    EXPECT_EQ(variants[0].at("overrides"), json::array());
    const std::string lowered = variants[2].at("overrides")[0];
    ASSERT_TRUE(lowered.starts_with("/lem/water/line=")) << lowered;
    for (const json& point : json::parse(lowered.substr(16)))
        EXPECT_LE(point[1], point[0] < 20 ? 11.41 : 11.61) << "no water above the ground";
    EXPECT_LT(made.scene.at("materials").at("CLAY_wet").at("law").at("phi_deg"), 30.0);
    EXPECT_EQ(made.scene.at("materials").at("clay"), test::materials().at("clay")) << "as given";
}

TEST(LiquefiedImport, DepthLayersLiquefyOneAfterTheOther) {
    Request request = liquefied("TAILINGS=0.08,0.3,CPTu");
    request.layers = {"TAILINGS=3,6"};
    const Imported made = imported(request);
    EXPECT_EQ(made.scene.at("lem").at("liquefaction"), json::parse(R"([{"region": "TAILINGS_0_3"},
        {"region": "TAILINGS_3_6"}, {"region": "TAILINGS_below_6"}])"));
    request.liquefied = {"TAILINGS_3_6=0.08,CPTu"};
    EXPECT_EQ(imported(request).scene.at("lem").at("liquefaction").size(), 1u);
}

TEST(LiquefiedImport, TheRunoutGoesOverTheDrawnTerrainElseTheDrawnGround) {
    const auto terrain = [](const std::string& more) {
        const Imported made = imported(liquefied("TAILINGS=0.08,CPTu", water, more));
        std::string from = remarks_of(made);
        for (const json& each : made.report.at("guessed"))
            if (each.at("pointer") == "/mpm/terrain") from = each.at("from");
        return std::pair(made.scene.at("mpm").at("terrain"), from);
    };
    const auto [drawn, why] =
        terrain(light("TERRAIN", {{-5, -10}, {120, -10}, {125, 0}, {300, -2}}, false));
    EXPECT_EQ(drawn.back(), json::parse("[300.0, -2.0]"));
    EXPECT_NE(why.find("the line that is drawn for it"), std::string::npos) << why;
    const auto [ground, from] = terrain(light("GROUND", {{80, 0}, {120, 0}, {160, -4}}, false));
    EXPECT_EQ(ground[ground.size() - 2], json::parse("[160.0, -4.0]"));
    EXPECT_LT(ground.back()[1], -5.9) << "it goes on falling by 5 %";
    EXPECT_NE(from.find("the drawn ground line, and beyond it ground that goes on falling by 5 %"),
              std::string::npos)
        << from;
    const auto [level, at] = terrain("");
    EXPECT_EQ(level.back()[1], 0.0);
    EXPECT_NE(at.find("on ground at the level there"), std::string::npos) << at;
}

TEST(LiquefiedImport, TheCrestIsWhereItIsDrawn) {
    const Imported made = imported(liquefied("TAILINGS=0.08,CPTu"));
    EXPECT_EQ(made.report.at("slope").at("crest"), json::parse("[55.0, 12.0]"));
    double highest = 0.0;
    for (const json& each : made.scene.at("section").at("regions"))
        for (const json& point : each.at("polygon")) highest = std::max<double>(highest, point[1]);
    EXPECT_EQ(highest, 12.0);
}

TEST(LiquefiedImport, AScenesMaterialsMakeTheSameSceneAgain) {
    Request request = liquefied("TAILINGS=0.08,CPTu", ponded);
    const Imported made = imported(request);
    request.materials = made.scene;
    EXPECT_EQ(imported(request).scene, made.scene);
    request.liquefied = {"TAILINGS=0.1,CPTu"};
    EXPECT_EQ(imported(request)
                  .scene.at("materials")
                  .at("tailings_liquefied")
                  .at("strength")
                  .at("peak")
                  .at("ratio"),
              0.1);
}

TEST(LiquefiedImport, AStrengthWithoutValueSourceOrRegionIsRefusedWithARemedy) {
    const std::string remedy = " | write REGION=0.08,SOURCE";
    const std::pair<const char*, std::string> slips[]{
        {"TAILINGS", "liquefied: \"TAILINGS\" names no region with a strength" + remedy},
        {"TAILINGS=", "liquefied: \"TAILINGS=\" gives no residual strength" + remedy},
        {"TAILINGS=weak,CPTu", "gives no residual strength" + remedy},
        {"TAILINGS=0.08", "names no source of its strength" + remedy},
        {"TAILINGS=0.08,0.2, ", "names no source of its strength" + remedy},
        {"TAILINGS=8,CPTu", "the strength is 8 sigma'_v0 | give 0.01 to 0.5"},
        {"TAILINGS=-4kPa,CPTu", "the strength is -4 kPa | give 0.01 to 0.5"},
        {"TAILINGS=0.3,0.2,CPTu", "has a peak of 0.2 sigma'_v0, below the residual strength"},
        {"SLIMES=0.08,CPTu",
         "liquefied: there is no region \"SLIMES\" | the regions are ROCK, CLAY"},
    };
    for (const auto& [entry, expected] : slips) {
        const std::string told = test::told(import_section(liquefied(entry)).faults);
        EXPECT_NE(told.find(expected), std::string::npos) << entry << "\n" << told;
    }
}

TEST(LiquefiedImport, WhatCannotLiquefyIsRefused) {
    const auto faults = [](const Request& request) {
        return test::told(import_section(request).faults);
    };
    const std::string dry = faults(liquefied("TAILINGS=0.08,CPTu", {{0, -1}, {120, -2}}));
    EXPECT_NE(dry.find("TAILINGS lies above the phreatic line"), std::string::npos) << dry;
    Request request = liquefied("TAILINGS=0.08,CPTu");
    request.liquefied.push_back("TAILINGS_below=0.1,CPTu");
    EXPECT_NE(faults(request).find("region TAILINGS_below has two residual strengths"),
              std::string::npos)
        << faults(request);
    request = liquefied("TAILINGS=0.08,CPTu");
    request.materials["tailings"]["law"]["phi_deg"] = 0;
    EXPECT_NE(faults(request).find("/materials/tailings: is not drained soil"), std::string::npos);
    request = liquefied("TAILINGS=0.08,CPTu");
    request.motion.emplace();
    EXPECT_NE(faults(request).find("leave out --with-fem, or --liquefied"), std::string::npos);
    request.motion.reset();
    request.drawing.bytes = dxf(light("ROCK", test::rock) + light("CLAY", test::clay) +
                                light("TAILINGS", test::tailings));
    EXPECT_NE(faults(request).find("phreatic: is missing"), std::string::npos) << faults(request);
}

}  // namespace
}  // namespace breach::importing::liquefy_test
