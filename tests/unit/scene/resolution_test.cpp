// Cells and elements across the lengths to resolve, and times that follow from the soil's height.
#include "core/scene/resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/scene/scene.hpp"

namespace breach {
namespace {

using nlohmann::json;

json dyke() {
    return json::parse(R"({
        "format": "breachline-scene/1", "name": "dyke",
        "materials": {
            "mud": {"density": 1800,
                "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 10}},
            "clay": {"density": 1800,
                "law": {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 30}}},
        "section": {"element_size": 1, "regions": [
            {"name": "pond", "material": "mud", "polygon": [[0,0],[40,0],[40,20],[0,20],[0,0]],
             "mesh": {"type": "unstructured"}},
            {"name": "dyke", "material": "clay", "polygon": [[40,0],[46,0],[46,20],[40,20],[40,0]],
             "mesh": {"type": "unstructured"}}]},
        "fem": {"supports": [{"name": "base", "from": [0,0], "to": [46,0], "fixes": "xy"}],
            "stages": [{"type": "dynamic", "name": "fall", "duration": 1, "time_step": 0.01}], "crest": [46, 20]},
        "mpm": {"cell_size": 0.5, "domain_x": [0, 120], "domain_y": [0, 40], "floor": {"level": 0},
            "duration": 10, "runout": {"toe": [46, 0]}}})");
}

scene::Scene read(const json& document) { return scene::parse_scene(document.dump(), "test"); }

std::vector<std::string> codes(const json& document) {
    std::vector<std::string> found;
    for (const fault::Flag& each : read(document).warnings)
        found.push_back(each.code + " " + name_of(each.severity) + " " + each.pointer);
    return found;
}

using Codes = std::vector<std::string>;

TEST(Cells, AcrossTheThinnestMobileRegionAreWarnedAboutBelowEight) {
    json document = dyke();
    EXPECT_EQ(codes(document), Codes{});
    document["mpm"]["cell_size"] = 1;  // six across the dyke
    EXPECT_EQ(codes(document), Codes{"coarse_cells warning /mpm/cell_size"});
    document["mpm"]["runout"]["regions"] = {"pond"};  // twenty
    EXPECT_EQ(codes(document), Codes{});
    document["mpm"]["runout"]["toe"] = {46, 15};  // and five over a step of 5 m
    EXPECT_EQ(codes(document), Codes{"coarse_cells warning /mpm/cell_size"});
    EXPECT_NE(read(document).warnings[0].message.find("the height of the slope, 5 m"),
              std::string::npos)
        << read(document).warnings[0].message;
}

TEST(Cells, AcrossAWeakLayerThatDoesNotCountForTheRunoutAreWarnedAboutBelowTwo) {
    json document = dyke();
    document["section"]["regions"].push_back(
        {{"name", "seam"},
         {"material", "mud"},
         {"polygon", {{40, -0.3}, {60, -0.3}, {60, 0}, {40, 0}, {40, -0.3}}},
         {"mesh", {{"type", "unstructured"}}}});
    document.erase("fem");
    document["mpm"]["domain_y"] = {-2, 40};
    document["mpm"]["floor"]["level"] = -2;
    document["mpm"]["runout"]["regions"] = {"dyke"};
    EXPECT_EQ(codes(document), Codes{"coarse_cells questionable /mpm/cell_size"});
    document["mpm"]["cell_size"] = 0.25;
    EXPECT_EQ(codes(document), Codes{"coarse_cells warning /mpm/cell_size"});
    document["materials"]["mud"]["law"]["phi_deg"] = 31;  // no longer weaker than the dyke
    EXPECT_EQ(codes(document), Codes{});
}

TEST(Cells, FewerThanTwoAreRefusedWithTheSizeThatWouldDoUnlessTheSceneSaysSo) {
    json document = dyke();
    document["mpm"]["cell_size"] = 5;
    try {
        read(document);
        FAIL() << "1.2 cells across the dyke";
    } catch (const fault::BadInput& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(error.faults()[0].pointer, "/mpm/cell_size");
        EXPECT_NE(error.faults()[0].cause.find("region \"dyke\""), std::string::npos)
            << error.faults()[0].cause;
        EXPECT_NE(error.faults()[0].remedy.find("allow_coarse_cells"), std::string::npos);
        // The remedy's size is accepted.
        const std::string& remedy = error.faults()[0].remedy;
        const double enough = std::stod(remedy.substr(remedy.find("/mpm/cell_size=") + 15));
        EXPECT_NEAR(enough, 3.0, 0.15);
        const scene::Scene coarse = [&] {
            json smaller = dyke();
            smaller["mpm"]["cell_size"] = enough;
            return read(smaller);
        }();
        EXPECT_FALSE(fault::is_questionable(coarse.warnings));
    }
    document["mpm"]["allow_coarse_cells"] = true;
    EXPECT_EQ(codes(document), Codes{"coarse_cells questionable /mpm/cell_size"});
}

/// Pointer and cause of a refusal, or nothing.
std::vector<std::string> refused(const json& document) {
    std::vector<std::string> found;
    try {
        read(document);
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults())
            found.push_back(each.pointer + ": " + each.cause);
    }
    return found;
}

TEST(NonlocalLength, IsAskedForWhereSoilBreaks) {
    json document = dyke();
    document["mpm"]["cell_size"] = 0.4;
    json& softening = document["materials"]["clay"]["law"]["softening"];
    softening = {{"epsilon_q_start", 0.01},
                 {"epsilon_q_end", 0.1},
                 {"c_residual_kPa", 0.5},
                 {"phi_residual_deg", 20}};
    EXPECT_EQ(codes(document), Codes{"local_softening warning /materials/clay"});
    softening["epsilon_q_end"] = 1.0;  // flows
    EXPECT_EQ(codes(document), Codes{});
}

TEST(NonlocalLength, HasToFitTheCellsAndTheRegion) {
    json document = dyke();  // 6 m wide
    document["mpm"]["cell_size"] = 0.4;
    document["section"]["element_size"] = 0.3;
    json& clay = document["materials"]["clay"];
    clay["nonlocal_length"] = 0.7;
    EXPECT_EQ(refused(document),
              Codes{"/materials/clay/nonlocal_length: belongs to a law that does not soften"});
    clay["law"]["softening"] = {{"epsilon_q_start", 0.01},
                                {"epsilon_q_end", 0.1},
                                {"c_residual_kPa", 0.5},
                                {"phi_residual_deg", 20}};
    ASSERT_EQ(refused(document).size(), 1U) << "no softening_length";
    document["mpm"]["softening_length"] = 0.5;
    EXPECT_EQ(codes(document), Codes{});
    clay["nonlocal_length"] = 0.6;
    EXPECT_EQ(codes(document),
              Codes{"short_nonlocal_length warning /materials/clay/nonlocal_length"});
    clay["nonlocal_length"] = 0.5;
    ASSERT_EQ(refused(document).size(), 1U);
    EXPECT_NE(refused(document)[0].find("1.25 cells"), std::string::npos) << refused(document)[0];
    clay["nonlocal_length"] = 1.0;
    EXPECT_EQ(codes(document), Codes{"wide_band warning /materials/clay/nonlocal_length"});
    document["materials"]["unused"] = clay;
    EXPECT_EQ(codes(document), Codes{"wide_band warning /materials/clay/nonlocal_length"});
}

/// The dyke for the FEM alone, its clay softening.
json softening_dyke_of_elements() {
    json document = dyke();
    document.erase("mpm");
    document["materials"]["clay"]["law"]["softening"] = {{"epsilon_q_start", 0.01},
                                                         {"epsilon_q_end", 0.1},
                                                         {"c_residual_kPa", 0.5},
                                                         {"phi_residual_deg", 20}};
    return document;
}

TEST(Softening, WithoutALengthIsWarnedAboutInTheFemWhereItsLawActs) {
    json document = softening_dyke_of_elements();
    EXPECT_EQ(codes(document), Codes{"local_softening warning /materials/clay"});
    EXPECT_NE(read(document).warnings[0].message.find("as wide as an element"), std::string::npos)
        << read(document).warnings[0].message;
    json elastic = document;
    elastic["fem"]["stages"][0]["laws"] = "elastic";
    EXPECT_EQ(codes(elastic), Codes{});
    document["materials"]["clay"]["law"]["softening"]["epsilon_q_end"] = 1.0;  // flows
    EXPECT_EQ(codes(document), Codes{});
}

TEST(Softening, OfNorSandIsWarnedAboutInTheFem) {
    json document = softening_dyke_of_elements();
    document["materials"]["clay"]["law"] = {
        {"type", "norsand"}, {"Gamma", 0.9},  {"lambda", 0.02}, {"M_tc", 1.2},
        {"N", 0.3},          {"chi_tc", 3.5}, {"H_0", 300},     {"G_ref_MPa", 30},
        {"m", 1.0},          {"nu", 0.15},    {"psi_0", 0.05},  {"K_0", 0.7}};
    EXPECT_EQ(codes(document), Codes{"local_softening warning /materials/clay"});
}

TEST(NonlocalLength, HasToFitTheElements) {
    json document = softening_dyke_of_elements();
    json& clay = document["materials"]["clay"];
    clay["nonlocal_length"] = 1.6;  // elements of 1 m
    EXPECT_EQ(codes(document), Codes{});
    clay["nonlocal_length"] = 1.5;
    EXPECT_EQ(codes(document),
              Codes{"short_nonlocal_length warning /materials/clay/nonlocal_length"});
    clay["nonlocal_length"] = 0.9;
    EXPECT_EQ(codes(document),
              Codes{"short_nonlocal_length questionable /materials/clay/nonlocal_length"});
    document["section"]["regions"][1]["mesh"] = {{"type", "block"}, {"divisions", {12, 40}}};
    EXPECT_EQ(codes(document), Codes{});
    clay["law"].erase("softening");
    EXPECT_EQ(refused(document),
              Codes{"/materials/clay/nonlocal_length: belongs to a law that does not soften"});
}

TEST(Cells, AreCountedAcrossRegionsOfOneStrengthThatTouch) {
    json document = dyke();
    document["mpm"]["cell_size"] = 2;
    ASSERT_EQ(codes(document), Codes{"coarse_cells warning /mpm/cell_size"});
    EXPECT_NE(read(document).warnings.at(0).message.find(
                  "only 3 cells of 2 m across the thickness of region \"dyke\", 6 m"),
              std::string::npos);
    document["materials"]["clay"]["law"]["phi_deg"] = 10;  // stiffness makes no difference
    document["materials"]["clay"]["law"]["E_MPa"] = 50;
    EXPECT_EQ(codes(document), Codes{});
}

TEST(Elements, OneAcrossARegionIsWarnedAbout) {
    json document = dyke();
    document["section"]["element_size"] = 4;
    EXPECT_EQ(codes(document), Codes{"coarse_elements warning /section/regions/1/mesh"});
    document["section"]["regions"][1]["mesh"] = {{"type", "block"}, {"divisions", {1, 20}}};
    EXPECT_EQ(codes(document), Codes{"coarse_elements warning /section/regions/1/mesh"});
    document["section"]["regions"][1]["mesh"] = {{"type", "block"}, {"divisions", {2, 20}}};
    EXPECT_EQ(codes(document), Codes{});
    document["section"]["regions"][1]["mesh"] = {{"type", "unstructured"}, {"element_size", 2}};
    EXPECT_EQ(codes(document), Codes{});
}

TEST(Rest, TimesFollowFromTheHeightOfTheMobileSoil) {
    json document = dyke();
    const double T = std::sqrt(20.0 / 9.81);
    scene::Mpm mpm = *read(document).mpm;
    EXPECT_DOUBLE_EQ(mpm.rest.window, 3.0 * T);
    EXPECT_DOUBLE_EQ(mpm.rest.earliest, 5.0 * T);
    EXPECT_DOUBLE_EQ(mpm.rest.change, 0.05);
    EXPECT_DOUBLE_EQ(mpm.rest.speed, 0.05);
    EXPECT_EQ(json::parse(read(document).completed)["mpm"]["rest_window"], "automatic");
    document["section"]["regions"][0]["polygon"] =
        json::parse("[[0,0],[40,0],[40,0.8],[0,0.8],[0,0]]");
    document["mpm"]["cell_size"] = 0.1;
    document["mpm"]["runout"]["regions"] = {"pond"};
    mpm = *read(document).mpm;
    EXPECT_DOUBLE_EQ(mpm.rest.window, 3.0 * std::sqrt(0.8 / 9.81));
    EXPECT_DOUBLE_EQ(mpm.rest.speed, 0.01 * std::sqrt(9.81 * 0.8)) << "a heap in the laboratory";
    document["mpm"]["rest_window"] = 2;
    EXPECT_EQ(read(document).mpm->rest.window, 2.0);
}

TEST(Duration, IsANumberOrUntilRestWithABound) {
    json document = dyke();
    EXPECT_FALSE(read(document).mpm->until_rest);
    document["mpm"]["duration"] = "until_rest";
    scene::Mpm mpm = *read(document).mpm;
    EXPECT_TRUE(mpm.until_rest);
    EXPECT_DOUBLE_EQ(mpm.duration, 100.0 * std::sqrt(std::hypot(120.0, 40.0) / 9.81));
    document["mpm"]["longest_duration"] = 300;
    EXPECT_EQ(read(document).mpm->duration, 300.0);
    document["mpm"]["duration"] = "until_then";
    EXPECT_THROW(read(document), fault::BadInput);
}

}  // namespace
}  // namespace breach
