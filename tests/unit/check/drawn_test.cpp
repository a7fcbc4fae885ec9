// Errors in a drawing: gaps, supports, water, terrain, slip surfaces.
#include "wrong.hpp"

namespace breach::check {
namespace {

const std::string upper_dam = "/section/regions/3/polygon";

TEST(Drawn, AGapOfACentimetreBetweenRegionsIsFoundWithItsPlaceAndWidth) {
    // The upper dam's lowest vertices moved by 1 cm: it no longer touches the lower dam.
    const Checked checked = changed(
        "mochikoshi", {upper_dam + "=[[109,29.4],[124.3,21],[151.9,12.41],[168.9,12.41],[115,30],"
                                   "[110,30],[109,29.4]]"});
    ASSERT_FALSE(checked.faults.empty());
    EXPECT_TRUE(has_fault(checked, upper_dam, "gap of 0.01 m to region \"lower_dam\""))
        << told(checked.faults);
}

TEST(Drawn, AGapOfThirtyCentimetresIsFoundAsWell) {
    const Checked checked =
        changed("slope", {"/section/regions/1/polygon=[[0,0.3],[30,0.3],[20,10],[0,10],[0,0.3]]"});
    EXPECT_TRUE(has_fault(checked, "/section/regions/1/polygon", "gap of 0.3 m to region \"base\""))
        << told(checked.faults);
}

TEST(Drawn, AWedgeBetweenRegionsThatMeetInOnePointIsAGap) {
    const Checked checked =
        changed("mochikoshi",
                {"/section/regions/1/polygon=[[-40,0],[133,0],[151.9,12.4],[124.1,20.8],[109,29.4],"
                 "[-40,29.4],[-40,0]]"});
    EXPECT_TRUE(has_fault(checked, upper_dam, "gap of")) << told(checked.faults);
}

TEST(Drawn, ARegionThatOverlapsAnotherIsNamedWithTheArea) {
    const Checked checked = changed(
        "mochikoshi", {upper_dam + "=[[109,29.4],[124.3,21],[151.9,12.39],[168.9,12.39],[115,30],"
                                   "[110,30],[109,29.4]]"});
    EXPECT_TRUE(has_fault(checked, upper_dam, "overlaps region \"lower_dam\""))
        << told(checked.faults);
}

TEST(Drawn, AThinLayerBetweenTwoRegionsIsNoGap) {
    // 0.3 m of the foundation as a region of its own, thinner than the elements.
    const Checked checked = changed(
        "mochikoshi",
        {"/section/regions/0/polygon=[[-40,-5],[280,-5],[280,-0.3],[-40,-0.3],[-40,-5]]",
         "/section/regions/0/mesh={\"type\":\"unstructured\"}",
         R"(/section/regions/4={"name":"blanket","material":"foundation","mesh":{"type":"unstructured"},)"
         R"("polygon":[[-40,-0.3],[280,-0.3],[280,0],[220,0],[133,0],[-40,0],[-40,-0.3]]})",
         R"(/transfer/mapping/4={"region":"blanket","to":"foundation_elastic"})"});
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
}

TEST(Drawn, AVertexThatIsAlmostAnotherIsASliver) {
    const Checked checked = changed(
        "mochikoshi", {upper_dam + "=[[109,29.4],[124.3,21],[151.9,12.4],[168.9,12.4],[115,30],"
                                   "[110.01,30],[110,30],[109,29.4]]"});
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
    EXPECT_TRUE(has_warning(checked, "sliver", upper_dam));
}

TEST(Drawn, ASupportBesideTheSectionIsRefusedWithItsDistance) {
    expect_only(changed("mochikoshi",
                        {"/fem/supports/0/from=[-40,-5.01]", "/fem/supports/0/to=[280,-5.01]"}),
                "/fem/supports/0", "0.01 m away from the section");
}

TEST(Drawn, ASupportThroughUnstructuredSoilHoldsNoNodeForCertain) {
    expect_only(
        changed("mochikoshi", {"/fem/supports/0/from=[110,15]", "/fem/supports/0/to=[120,15]"}),
        "/fem/supports/0", "crosses the soil");
}

TEST(Drawn, ASupportThatMeetsTheSectionInOnePointIsWarnedAbout) {
    const Checked checked = changed("mochikoshi", {"/fem/supports/0/from=[-40,-8]"});
    EXPECT_TRUE(has_warning(checked, "hardly_held", "/fem/supports/0")) << told(checked.faults);
}

TEST(Drawn, ASupportOfAPartOfTheLowestSideIsWarnedAbout) {
    const Checked checked = changed("mochikoshi", {"/fem/supports/0/from=[-40,-5]"});
    EXPECT_TRUE(has_warning(checked, "hardly_held", "/fem/supports")) << told(checked.faults);
    EXPECT_FALSE(has_warning(changed("mochikoshi", {}), "hardly_held", "/fem/supports"));
}

TEST(Drawn, ABodyThatIsHeldInOneDirectionOnlyIsRefused) {
    expect_only(changed("mochikoshi", {"/fem/supports/0/fixes=x"}), "/fem/supports",
                "nothing holds the body in y");
}

TEST(Drawn, ARegionFarFromTheOthersNeedsASupportOfItsOwn) {
    const Checked checked = changed(
        "mochikoshi", {R"(/section/regions/4={"name":"island","material":"foundation",)"
                       R"("mesh":{"type":"unstructured"},)"
                       R"("polygon":[[240,10],[260,10],[260,20],[240,20],[240,10]]})",
                       R"(/transfer/mapping/4={"region":"island","to":"foundation_elastic"})"});
    EXPECT_TRUE(has_fault(checked, "/fem/supports", "region \"island\"")) << told(checked.faults);
    // The slices of the stability analysis find the air below it.
    EXPECT_TRUE(has_fault(checked, "/section/regions", "air below ground")) << told(checked.faults);
}

TEST(Drawn, AFreeFieldColumnNeedsAVerticalSideWithoutSupports) {
    expect_only(
        changed(
            "mochikoshi",
            {R"(/fem/supports/1={"name":"left","from":[-207.5,-5],"to":[-207.5,29.4],"fixes":"x"})"}),
        "/fem/supports/1", "where a free-field column stands");
    const Checked slanted = changed(
        "mochikoshi", {"/section/regions/0/"
                       "polygon=[[-207.5,-5],[280,-5],[281,-2],[280,0],[220,0],[133,0],[-207.5,0],"
                       "[-207.5,-5]]",
                       "/section/regions/0/mesh={\"type\":\"unstructured\"}"});
    EXPECT_TRUE(has_fault(slanted, "/fem/free_field", "not one vertical line"))
        << told(slanted.faults);
}

TEST(Drawn, ACrestFarFromTheSectionIsWarnedAbout) {
    expect_only(changed("mochikoshi", {"/fem/crest=[615,30]"}), "/fem/crest",
                "away from the section");
    const Checked near = changed("mochikoshi", {"/fem/crest=[115,34]"});
    EXPECT_TRUE(near.faults.empty()) << told(near.faults);
    EXPECT_TRUE(has_warning(near, "far_crest", "/fem/crest"));
    EXPECT_FALSE(has_warning(changed("mochikoshi", {}), "far_crest", "/fem/crest"));
}

TEST(Drawn, WaterBelowAllSoilIsRefused) {
    expect_only(changed("mochikoshi", {"/fem/water/line=[[-40,-6],[280,-7]]"}), "/fem/water/line",
                "runs below all soil, by at least 1 m");
    expect_only(changed("mochikoshi", {"/transfer/phreatic_line=[[-40,-6],[280,-7]]"}),
                "/transfer/phreatic_line", "nothing would be saturated");
}

TEST(Drawn, WaterOfTheStabilityAnalysisBelowOrBesideAllSoilIsRefused) {
    expect_only(changed("mochikoshi", {"/lem/water/line=[[-40,-170.6],[109,-170.6],[280,-200]]"}),
                "/lem/water/line", "runs below all soil");
    expect_only(changed("mochikoshi", {"/lem/water/line=[[4960,29.4],[5109,29.4],[5280,0]]"}),
                "/lem/water/line", "beside the section");
}

TEST(Drawn, UndrawnWaterBeyondALinesEndIsWarnedAbout) {
    const std::string to_the_face = "[[-40,29.4],[109,29.4],[124.3,21],[151.9,12.4]]";
    EXPECT_TRUE(has_warning(changed("mochikoshi", {"/lem/water/line=" + to_the_face}),
                            "undrawn_water", "/lem/water/line"));
    EXPECT_TRUE(has_warning(changed("mochikoshi", {"/fem/water/line=" + to_the_face}),
                            "undrawn_water", "/fem/water/line"));
    const Checked as_shipped = changed("mochikoshi", {});
    EXPECT_FALSE(has_warning(as_shipped, "undrawn_water", "/lem/water/line"));
    EXPECT_FALSE(has_warning(as_shipped, "undrawn_water", "/fem/water/line"));
}

TEST(Drawn, ABoundaryOfPressureThatMissesTheSectionIsRefused) {
    expect_only(changed("mochikoshi", {R"(/fem/water/boundaries=[{"name":"pond","from":[-40,30],)"
                                       R"("to":[100,30],"level":31}])"}),
                "/fem/water/boundaries/0", "0.6 m away from the section");
}

TEST(Drawn, LiquefactionWatchedWhereThereIsNoSuchSoilIsRefused) {
    expect_only(changed("mochikoshi", {"/fem/liquefaction/x=[200,220]"}), "/fem/liquefaction/x",
                "no soil of these regions");
}

TEST(Drawn, TerrainThroughTheDamIsRefusedWithItsDepth) {
    expect_only(changed("mochikoshi", {"/mpm/terrain=[[-41,-2],[660,-2]]"}), "/mpm/terrain",
                "reaches 3 m below it");
}

TEST(Drawn, AToeOutsideTheGridIsRefused) {
    expect_only(changed("mochikoshi", {"/mpm/runout/toe=[720,0]"}), "/mpm/runout/toe",
                "outside the grid");
}

TEST(Drawn, AGridTooSmallForTheSectionIsRefused) {
    const Checked checked = changed("mochikoshi", {"/mpm/domain_x=[-40.5,199.5]"});
    EXPECT_TRUE(has_fault(checked, "/section/regions/0/polygon", "outside the MPM grid"));
    EXPECT_TRUE(has_fault(checked, "/mpm/runout/toe", "outside the grid"));
    EXPECT_TRUE(has_fault(checked, "/mpm/gauges/0/x", "outside the grid"));
}

TEST(Drawn, SlipSurfacesThatEndWhereThereIsNoGroundAreRefused) {
    expect_only(changed("mochikoshi", {"/lem/search/exit=[300,340]"}), "/lem/search/exit",
                "lies beside the section");
    expect_only(changed("mochikoshi", {"/lem/search/exit=[60,80]", "/lem/search/entry=[221,250]"}),
                "/lem/search/entry", "lies at most at 0 m, and exit nowhere below 29.4 m");
}

TEST(Drawn, SlipSurfacesBelowTheModelOrThroughTheAirAreRefused) {
    expect_only(changed("mochikoshi", {"/lem/search/lowest_level=31"}), "/lem/search/lowest_level",
                "not below the ground");
    expect_only(changed("mochikoshi", {R"(/lem/circle={"center":[150,100],"radius":20})"}),
                "/lem/circle", "without cutting it");
    expect_only(
        changed("mochikoshi", {R"(/lem/surcharge=[{"from":290,"to":300,"pressure_kPa":10}])"}),
        "/lem/surcharge/0", "beside the section");
}

TEST(Drawn, LayersThatLieOutsideTheirRegionOrInEachOtherAreRefused) {
    expect_only(changed("mochikoshi", {"/lem/liquefaction/0/levels=[30,32]"}),
                "/lem/liquefaction/0/levels", "lie outside region \"tailings\"");
    expect_only(changed("mochikoshi", {"/lem/liquefaction/1/levels=[17.64,24]"}),
                "/lem/liquefaction/1/levels", "overlap those of layer 0");
}

TEST(Drawn, LayersListedFromTheBottomUpAreRefused) {
    const std::string upwards =
        R"([{"region":"tailings","levels":[0,5.88]},{"region":"tailings","levels":[5.88,11.76]}])";
    expect_only(changed("mochikoshi", {"/lem/liquefaction=" + upwards}), "/lem/liquefaction/1",
                "lies on layer 0, which is listed before it");
    const std::string sound =
        R"([{"region":"tailings","levels":[11.76,29.4]},{"region":"lower_dam","levels":[11.76,12.4]},)"
        R"({"region":"tailings","levels":[0,11.76]},{"region":"lower_dam","levels":[0,11.76]}])";
    const Checked by_levels = changed("mochikoshi", {"/lem/liquefaction=" + sound});
    EXPECT_TRUE(by_levels.faults.empty()) << told(by_levels.faults);
}

TEST(Drawn, DecisionsOfATransferAreReportedWherePointsFillTheSection) {
    const std::string mapping =
        R"(/transfer/mapping=[{"region":"slope","to":"tailings","saturated":"tailings"}])";
    const Checked checked =
        changed("flow_slope", {mapping, "/transfer/phreatic_line=[[0,8],[60,0]]"});
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
    EXPECT_TRUE(has_warning(checked, "needs_fem", "/transfer/mapping/0/saturated"));
}

TEST(Drawn, LoadsThatEndAtTheTransferAreWarnedAbout) {
    const Checked loaded =
        changed("slope", {R"(/fem/surcharge=[{"from":0,"to":4,"pressure_kPa":10}])"});
    EXPECT_TRUE(loaded.faults.empty()) << told(loaded.faults);
    EXPECT_TRUE(has_warning(loaded, "load_ends", "/fem/surcharge"));
    const Checked lifted = changed(
        "slope",
        {R"(/fem/surcharge=[{"from":0,"to":4,"pressure_kPa":10}])", "/fem/stages/1/surcharge=[]"});
    EXPECT_FALSE(has_warning(lifted, "load_ends", "/fem/surcharge"));
    EXPECT_FALSE(has_warning(lifted, "load_ends", "/fem/stages/1/surcharge"));
    const Checked flooded = changed("mochikoshi", {"/fem/water/line=[[0,40],[400,40]]"});
    EXPECT_TRUE(has_warning(flooded, "load_ends", "/fem/water/line"));
}

TEST(Drawn, AnUpstreamEndThatOnlyTheFemHoldsIsWarnedAbout) {
    EXPECT_FALSE(has_warning(changed("mochikoshi", {}), "free_upstream_end", "/mpm/domain_x"));
    const Checked open =
        changed("mochikoshi", {"/mpm/domain_x=[-248, 692]", "/mpm/floor/friction/0/from=-248"});
    EXPECT_TRUE(open.faults.empty()) << told(open.faults);
    EXPECT_TRUE(has_warning(open, "free_upstream_end", "/mpm/domain_x"));
    const Checked held =
        changed("mochikoshi", {"/mpm/domain_x=[-248, 692]", "/mpm/floor/friction/0/from=-248",
                               "/mpm/terrain=[[-248,29.4],[-208.5,29.4],[-208,-6],[692,-6]]"});
    EXPECT_FALSE(has_warning(held, "free_upstream_end", "/mpm/domain_x"));
}

TEST(Drawn, FrictionBelowTheWaterTableIsWarnedAboutWherePointsFillTheSection) {
    const Checked wet = changed("merriespruit", {});
    EXPECT_TRUE(has_warning(wet, "total_stress", "/materials/embankment"));
    EXPECT_FALSE(
        has_warning(changed("mochikoshi", {}), "total_stress", "/materials/embankment_saturated"));
}

TEST(Drawn, DepthsThatAreCountedFromTwoLevelsAreWarnedAbout) {
    EXPECT_TRUE(has_warning(changed("mochikoshi", {"/fem/liquefaction/level=60"}), "depths_differ",
                            "/fem/liquefaction/level"));
    EXPECT_FALSE(
        has_warning(changed("mochikoshi", {}), "depths_differ", "/fem/liquefaction/level"));
}

}  // namespace
}  // namespace breach::check
