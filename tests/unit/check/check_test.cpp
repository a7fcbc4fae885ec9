// What the phases require of laws, materials and files; all faults in one list.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/folder.hpp"
#include "wrong.hpp"

namespace breach::check {
namespace {

TEST(Check, RefusesSoilSofterThanItsFallAllowsAndSaysWhatWouldDo) {
    const Checked checked = changed("mochikoshi", {"/mpm/stiffness_scale=1e-3"});
    expect_only(checked, "/mpm/stiffness_scale", "Mach 0.42");
    EXPECT_NE(checked.faults[0].remedy.find("at least 0.002, or"), std::string::npos)
        << checked.faults[0].remedy;
    EXPECT_TRUE(changed("mochikoshi", {"/mpm/stiffness_scale=0.002"}).faults.empty());
}

/// slope.json in millimetres: its section is 6 cm long.
TEST(Check, CellsThatFitASmallSectionAreNoSlip) {
    auto document = nlohmann::json::parse(file_text(BREACH_ROOT "/workflows/scenes/slope.json"));
    for (nlohmann::json& region : document["section"]["regions"])
        for (nlohmann::json& point : region["polygon"])
            point = {1e-3 * point[0].get<double>(), 1e-3 * point[1].get<double>()};
    const double cell = document["mpm"]["cell_size"].get<double>();
    const auto suspects = [&](double size) {
        document["mpm"]["cell_size"] = size;
        return has_warning(
            checked_text(document.dump(), "small", BREACH_ROOT "/workflows/scenes", {}),
            "implausible", "/mpm/cell_size");
    };
    EXPECT_FALSE(suspects(1e-3 * cell));
    EXPECT_TRUE(suspects(1e-6 * cell));
}

TEST(Check, SurchargeOfTheFemBesideTheSectionIsRefusedAndPascalsAreSuspected) {
    const auto with = [](const std::string& surcharge) {
        return changed("slope", {"/fem/stages/0/surcharge=[" + surcharge + "]"});
    };
    expect_only(with(R"({"from":900,"to":950,"pressure_kPa":10})"), "/fem/stages/0/surcharge/0",
                "lies beside the section");
    EXPECT_TRUE(has_warning(with(R"({"from":2,"to":9,"pressure_kPa":20000})"), "implausible",
                            "/fem/stages/0/surcharge/0/pressure_kPa"));
    EXPECT_FALSE(has_warning(with(R"({"from":2,"to":9,"pressure_kPa":20})"), "implausible",
                             "/fem/stages/0/surcharge/0/pressure_kPa"));
}

TEST(Check, SandWithoutAMappingCannotBecomePoints) {
    const Checked checked = changed(
        "mochikoshi", {R"(/transfer/mapping=[{"region":"foundation","to":"foundation_elastic"},)"
                       R"({"region":"tailings","to":"tailings_not_liquefied"}])"});
    ASSERT_EQ(checked.faults.size(), 2u) << told(checked.faults);
    EXPECT_TRUE(has_fault(checked, "/section/regions/2/material", "pm4sand")) << "lower dam";
    EXPECT_TRUE(has_fault(checked, "/section/regions/3/material", "pm4sand")) << "upper dam";
    EXPECT_NE(checked.faults[0].remedy.find("{\"region\": \"lower_dam\", \"to\": ...}"),
              std::string::npos);
}

TEST(Check, SandWithoutPointsNeedsNoMapping) {
    auto document =
        nlohmann::json::parse(file_text(BREACH_ROOT "/workflows/scenes/mochikoshi.json"));
    document.erase("mpm");
    document["transfer"] = nlohmann::json::object();
    const Checked checked =
        checked_text(document.dump(), "fem only", BREACH_ROOT "/workflows/scenes", {});
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
}

TEST(Check, WetSoilNeedsVoidRatioAndPermeability) {
    const std::string without = R"(={"density":1865.4,"limit_strength":{"c_kPa":0,"phi_deg":30},)"
                                R"("law":{"type":"pm4sand","D_R":0.35,"G_0":476,"h_po":2.7}})";
    expect_only(changed("mochikoshi", {"/materials/tailings" + without}), "/materials/tailings",
                "lacks void_ratio and permeability");
    // The same material above the line needs neither.
    const Checked dry =
        changed("mochikoshi", {"/materials/embankment" + without,
                               "/fem/water/line=[[-40,29.4],[100,20],[133,0],[220,0],[280,0]]"});
    EXPECT_TRUE(dry.faults.empty()) << told(dry.faults);
}

TEST(Check, EffectiveStressOfWetFrictionalSoilCannotGoToTheMpm) {
    expect_only(changed("mochikoshi", {"/transfer/stress=effective"}), "/transfer/stress",
                "pore pressure");
}

TEST(Check, SandAsksForElasticStagesFirst) {
    expect_only(
        changed(
            "mochikoshi",
            {R"(/fem/stages/3={"type":"dynamic","name":"after","laws":"elastic","duration":1,"time_step":0.002})"}),
        "/fem/stages/3/laws", "after PM4Sand has begun");
}

TEST(Check, WindowsAreReadAndAskForWhatIsRecorded) {
    expect_only(changed("mochikoshi", {"/transfer/window/lower=failure_surfaces >"}),
                "/transfer/window/lower", "");
    expect_only(changed("mochikoshi", {"/transfer/window/lower=pore_joy > 3"}),
                "/transfer/window/lower", "pore_joy");
    EXPECT_TRUE(
        has_fault(changed("slope", {R"(/transfer/window={"lower":"liquefaction_depth > 3"})"}),
                  "/transfer/window/lower", "no soil is watched"));
}

TEST(Check, SofteningOfSoilThatDrainsIsWarnedOf) {
    const auto warned = [](const std::vector<std::string>& overrides) {
        return has_warning(changed("static_lift", overrides), "drained_softening",
                           "/fem/stages/1/S");
    };
    EXPECT_FALSE(warned({})) << "in motion alone";
    EXPECT_TRUE(warned({"/fem/stages/1/S=1"}));
    EXPECT_TRUE(warned({R"(/fem/stages/1/S={"tailings":0.5})"}));
    EXPECT_FALSE(warned({"/fem/stages/1/S=0"}));
}

TEST(Check, AStrengthOfDynamicStagesNeedsWaterAStaticStageAndAFrictionalLaw) {
    using nlohmann::json;
    auto scene = json::parse(file_text(BREACH_ROOT "/workflows/scenes/slope.json"));
    json& soil = scene["materials"]["base_soil"];
    soil.update({{"void_ratio", 1.0}, {"permeability", {1e-9, 1e-9}}});
    soil["dynamic_strength"] = {{"ratio", 0.2}};
    const std::string pointer = "/materials/base_soil/dynamic_strength";
    const auto findings = [&] { return checked_text(scene.dump(), "clay", BREACH_ROOT, {}); };
    expect_only(findings(), pointer, "the scene has no water");
    scene["fem"]["water"] = {{"line", {{0, -1}}}};
    const json sound = scene;
    EXPECT_EQ(told(findings().faults), "");
    EXPECT_FALSE(has_warning(findings(), "implausible", pointer));
    scene["fem"]["stages"] = {sound["fem"]["stages"][0]};
    EXPECT_TRUE(has_warning(findings(), "implausible", pointer)) << "no stage is dynamic";
    scene["fem"]["stages"] = {sound["fem"]["stages"][1]};
    EXPECT_TRUE(has_fault(findings(), pointer, "no static stage"));
    scene = sound;
    scene["materials"]["base_soil"]["law"] = {
        {"type", "linear_elastic"}, {"E_MPa", 50}, {"nu", 0.3}};
    EXPECT_TRUE(has_fault(findings(), pointer, "no c and phi"));
    scene["materials"]["base_soil"]["law"] = scene["materials"]["slope_soil"]["law"];
    EXPECT_TRUE(has_fault(findings(), pointer, "softens"));
    scene = sound;
    scene["materials"]["base_soil"]["dynamic_strength"]["ratio"] = 0;
    EXPECT_TRUE(has_fault(findings(), pointer + "/ratio"));
}

TEST(Check, NorSandsUndrainedStrengthIsOfWetSoil) {
    const Checked dry = changed("static_lift", {"/lem/water/regions=[\"foundation\"]"});
    expect_only(dry, "/lem/undrained/0/norsand", "without water");
    const std::string r_u = R"(/lem/pore_pressure_ratios=[{"region":"tailings","r_u":0.3}])";
    EXPECT_TRUE(
        changed("static_lift", {"/lem/water/regions=[\"foundation\"]", r_u}).faults.empty());
}

TEST(Check, SoilThatFailsUndrainedHasAStrength) {
    expect_only(changed("static_lift", {R"(/lem/undrained=[{"region":"tailings"}])"}),
                "/lem/undrained/0", "s_u would be 0");
    const std::string layer = R"(/lem/liquefaction=[{"region":"tailings"}])";
    EXPECT_TRUE(has_warning(changed("static_lift", {layer}), "no_residual_strength",
                            "/lem/liquefaction/0"));
    const std::string residual =
        R"(/lem/liquefaction=[{"region":"tailings","residual_strength_kPa":5}])";
    EXPECT_FALSE(has_warning(changed("static_lift", {residual}), "no_residual_strength",
                             "/lem/liquefaction/0"));
}

TEST(Check, AMeshFileThatIsMissingOrNoMeshIsRefused) {
    expect_only(changed("slope", {"/fem/msh_file=nowhere.msh"}), "/fem/msh_file", "does not exist");
    expect_only(changed("slope", {"/fem/msh_file=/dev/zero"}), "/fem/msh_file", "cannot be read");
    expect_only(changed("slope", {"/fem/msh_file=/" + std::string(5000, 'a')}), "/fem/msh_file",
                "does not exist");
    expect_only(changed("slope", {"/fem/msh_file=slope.json"}), "/fem/msh_file",
                "does not begin with $MeshFormat");
}

TEST(Check, AMeshFileNeedsASurfaceForEveryRegion) {
    const test::Folder folder;
    const auto file = folder / "one_surface.msh";
    std::ofstream(file) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n"
                           "2 1 \"slope\"\n$EndPhysicalNames\n";
    const Checked checked = changed("slope", {"/fem/msh_file=" + file.string()});
    ASSERT_FALSE(checked.faults.empty());
    for (const fault::Fault& each : checked.faults)
        EXPECT_NE(each.cause.find("has no physical surface"), std::string::npos) << each.cause;
}

TEST(Check, OneListHoldsTheReadersFaultsAndThoseOfEveryPhase) {
    const Checked checked =
        changed("mochikoshi",
                {"/materials/liquefied_1/density=-5",  // schema
                 "/fem/snapshot_times=[99]",           // reader
                 "/fem/supports/0/from=[-40,-6]", "/fem/supports/0/to=[280,-6]",
                 "/fem/motion/file=../motions/none.csv",
                 "/transfer/phreatic_line=[[-40,-6],[280,-6]]", "/mpm/terrain=[[-41,-2],[660,-2]]",
                 "/mpm/runout/toe=[720,0]", "/lem/search/exit=[300,340]"});
    EXPECT_TRUE(has_fault(checked, "/materials/liquefied_1/density"));
    EXPECT_TRUE(has_fault(checked, "/fem/snapshot_times"));
    EXPECT_TRUE(has_fault(checked, "/fem/supports/0"));
    EXPECT_TRUE(has_fault(checked, "/fem/motion/file"));
    EXPECT_TRUE(has_fault(checked, "/transfer/phreatic_line"));
    EXPECT_TRUE(has_fault(checked, "/mpm/terrain"));
    EXPECT_TRUE(has_fault(checked, "/mpm/runout/toe"));
    EXPECT_TRUE(has_fault(checked, "/lem/search/exit"));
}

TEST(Check, APartWithAFaultOfItsOwnDoesNotHideTheOthers) {
    const Checked checked = changed(
        "mochikoshi", {"/fem/newmark_beta=-1", "/section/regions/3/polygon=[[0,0],[1,1],[0,0]]",
                       "/section/regions/2/material=nothing", "/mpm/runout/toe=[720,0]",
                       "/lem/search/exit=[300,340]"});
    EXPECT_TRUE(has_fault(checked, "/fem/newmark_beta"));
    EXPECT_TRUE(has_fault(checked, "/section/regions/2/material"));
    EXPECT_TRUE(has_fault(checked, "/section/regions/3/polygon"));
    EXPECT_TRUE(has_fault(checked, "/mpm/runout/toe"));
    EXPECT_TRUE(has_fault(checked, "/lem/search/exit"));
}

}  // namespace
}  // namespace breach::check
