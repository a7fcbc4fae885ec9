// From a drawing to a checked and meshed scene, or to a list of faults.
#include "services/import/import.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "core/check/check.hpp"
#include "core/geometry/polyline.hpp"
#include "drawings.hpp"
#include "fem_solver/mesh/mesh.hpp"
#include "tests/folder.hpp"

namespace breach::importing::import_test {
namespace {

using mechanics::Vec2;
using nlohmann::json;
using test::dxf;
using test::light;
using test::Line;

std::string section(double jitter = 0.0, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-jitter, jitter);
    const auto moved = [&](Line ring) {
        for (Vec2& each : ring) each += Vec2(off(random), off(random));
        return ring;
    };
    return light("ROCK", moved(test::rock)) + light("CLAY", moved(test::clay)) +
           light("TAILINGS", moved(test::tailings));
}
const std::string water = light("PHREATIC", {{120, -0.5}, {75, 1}, {40, 8}, {0, 9}}, false);

const json& region(const json& scene, const std::string& name) {
    for (const json& each : scene.at("section").at("regions"))
        if (each.at("name") == name) return each;
    throw std::out_of_range(name);
}

double area_of(const json& region) {
    geometry::Polygon ring;
    for (const json& each : region.at("polygon")) ring.emplace_back(each[0], each[1]);
    ring.pop_back();
    return geometry::area(ring);
}

/// Length of element sides of one element only [m].
double free_border(const fem::Mesh& mesh) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    for (const fem::Quad& quad : mesh.quads)
        for (std::size_t k = 0; k < 4; ++k) ++uses[std::minmax(quad[k], quad[(k + 1) % 4])];
    double length = 0.0;
    for (const auto& [edge, count] : uses)
        if (count == 1) length += (mesh.nodes[edge.first] - mesh.nodes[edge.second]).norm();
    return length;
}

TEST(Import, ADrawingBecomesASceneWithItsWaterAndGuessedSearch) {
    const Imported imported = import_section(test::request(dxf(section() + water)));
    ASSERT_EQ(test::told(imported.faults), "");
    const json& scene = imported.scene;
    EXPECT_EQ(scene.at("name"), "dam");
    EXPECT_EQ(region(scene, "CLAY").at("material"), "clay");
    EXPECT_EQ(scene.at("lem").at("water").at("line"),
              json::parse("[[0.0,9.0],[40.0,8.0],[75.0,1.0],[120.0,-0.5]]"));
    const auto& search = scene.at("lem").at("search");
    EXPECT_LT(search.at("entry")[1], search.at("exit")[0]);
    EXPECT_LE(search.at("entry")[0], 55.0);
    EXPECT_GE(search.at("exit")[1], 80.0);
    EXPECT_EQ(imported.report.at("guessed").size(), 3u);
    EXPECT_TRUE(imported.report.at("healed").empty());
    check::Checked read = check::checked_text(scene.dump(), "scene", ".", {});
    EXPECT_EQ(test::told(read.faults), "");
}

TEST(Import, ARegionDrawnAsAHatchIsARegion) {
    const std::string rest = light("ROCK", test::rock) + light("CLAY", test::clay) + water;
    const auto scene = [&](const std::string& tailings) {
        const Imported imported = import_section(test::request(dxf(rest + tailings)));
        EXPECT_EQ(test::told(imported.faults), "");
        return imported.scene;
    };
    EXPECT_EQ(scene(test::hatch("TAILINGS", {test::path(test::tailings)})),
              scene(light("TAILINGS", test::tailings)));
}

TEST(Import, AHatchInAnOutlineOfItsLayerRepeatsIt) {
    Line turned(test::clay.rbegin(), test::clay.rend());
    const Line strip{{30, 0}, {40, 0}, {42, 3}, {31, 2}};
    const json plain = import_section(test::request(dxf(section() + water))).scene;
    const std::string hatched = test::hatch("CLAY", {test::path(turned), test::path(strip)}) +
                                test::hatch("CLAY", {test::path(strip)});
    EXPECT_EQ(import_section(test::request(dxf(section() + hatched + water))).scene, plain);
    // Also where single lines are the outline, and where one hatch lies on another.
    const std::string rest = light("ROCK", test::rock) + light("TAILINGS", test::tailings) + water;
    const std::string twice =
        test::hatch("CLAY", {test::path(strip)}) + test::hatch("CLAY", {test::path(turned)});
    for (const std::string& clay : {test::sides("CLAY", test::clay) + hatched, twice}) {
        const Imported imported = import_section(test::request(dxf(rest + clay)));
        ASSERT_EQ(test::told(imported.faults), "");
        EXPECT_NEAR(area_of(region(imported.scene, "CLAY")), area_of(region(plain, "CLAY")), 1e-9);
    }
}

TEST(Import, AHatchWithAnIslandIsRefused) {
    const Line lens{{45, 4}, {55, 4}, {52, 8}};
    const std::string rest = light("ROCK", test::rock) + light("TAILINGS", test::tailings);
    const Imported imported = import_section(
        test::request(dxf(rest + test::hatch("CLAY", {test::path(test::clay), test::path(lens)}))));
    ASSERT_EQ(imported.faults.size(), 1u) << test::told(imported.faults);
    EXPECT_NE(imported.faults[0].cause.find("on layer CLAY has an island at (45, 4)"),
              std::string::npos);
}

TEST(Import, ASlopeThatFallsToTheLeftIsSearchedThere) {
    const Line mirrored{{-80, 0}, {-20, 0}, {-50, 12}, {-55, 12}};
    const Imported imported = import_section(test::request(dxf(light("CLAY", mirrored))));
    ASSERT_EQ(test::told(imported.faults), "");
    const auto& search = imported.scene.at("lem").at("search");
    // Both faces are 12 m high; the left one falls over 25 m, the right one over 30 m.
    EXPECT_GT(search.at("entry")[0], search.at("exit")[1]);
}

TEST(Import, AHealedDrawingIsMeshedWithoutAGap) {
    // Inaccurate by a centimetre, drawn in millimetres, one region as single lines.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> off(-0.01, 0.01);
    const auto millimetres = [&](Line ring) {
        for (Vec2& each : ring) each = 1e3 * (each + Vec2(off(random), off(random)));
        return ring;
    };
    Request request = test::request(dxf(test::heavy("ROCK", millimetres(test::rock)) +
                                            test::sides("CLAY", millimetres(test::clay)) +
                                            light("TAILINGS", millimetres(test::tailings)),
                                        4));
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_FALSE(imported.report.at("healed").empty());
    const scene::Scene scene = scene::parse_scene(imported.scene.dump(), "scene");
    const breach::test::Folder folder;
    const fem::Mesh mesh = fem::mesh_with_gmsh(scene.section, folder.path());
    EXPECT_GT(mesh.quads.size(), 500u);
    double outline = 0.0;  // of the whole section, as it was meant
    const Line whole{{0, -10}, {120, -10}, {120, 0}, {80, 0}, {55, 12}, {50, 12}, {0, 11}};
    for (std::size_t i = 0; i < whole.size(); ++i)
        outline += (whole[(i + 1) % whole.size()] - whole[i]).norm();
    EXPECT_NEAR(free_border(mesh), outline, 0.2);  // a gap of any region would add its length
}

TEST(Import, LayersBelowThePhreaticLineHaveTheirAreasAndTheNeighboursTheirVertices) {
    // A block of 10 by 8 m; the line falls from y = 7 to 6: 1 m of soil above it at x = 0, 2 at 10.
    Request request = test::request(dxf(light("TAILINGS", {{0, 0}, {10, 0}, {10, 8}, {0, 8}}) +
                                        light("CLAY", {{10, 0}, {30, 0}, {10, 8}}) +
                                        light("PHREATIC", {{0, 7}, {10, 6}}, false)));
    request.layers = {"tailings=2,4.5"};
    request.materials["TAILINGS_0_2"] = request.materials["tailings"];
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    const json& scene = imported.scene;
    EXPECT_NEAR(area_of(region(scene, "TAILINGS_above")), 15.0, 1e-9);
    EXPECT_NEAR(area_of(region(scene, "TAILINGS_0_2")), 20.0, 1e-9);
    EXPECT_NEAR(area_of(region(scene, "TAILINGS_2_4p5")), 25.0, 1e-9);
    EXPECT_NEAR(area_of(region(scene, "TAILINGS_below_4p5")), 20.0, 1e-9);
    EXPECT_EQ(region(scene, "TAILINGS_0_2").at("material"), "TAILINGS_0_2");
    EXPECT_EQ(region(scene, "TAILINGS_above").at("material"), "tailings");
    EXPECT_EQ(region(scene, "CLAY").at("polygon").size(), 7u);  // three cuts end at its side
    const breach::test::Folder folder;
    const scene::Scene read = scene::parse_scene(scene.dump(), "scene");
    EXPECT_NEAR(free_border(fem::mesh_with_gmsh(read.section, folder.path())),
                8 + 10 + 20 + std::hypot(20.0, 8.0) + 10, 1e-6);
    request.layers = {"TAILINGS=2", "dam=1"};
    EXPECT_NE(test::told(import_section(request).faults).find("there is no region \"dam\""),
              std::string::npos);
    request.layers = {"TAILINGS=3,2"};
    EXPECT_NE(test::told(import_section(request).faults).find("ascending depths"),
              std::string::npos);
}

TEST(Import, ALayerThatWouldBeThinnerThanTheToleranceIsTakenIn) {
    Request request =
        test::request(dxf(light("TAILINGS", {{0, 0}, {10, 0}, {10, 7.03}, {0, 7.03}})));
    request.layers = {"TAILINGS=2"};
    request.phreatic = {"water.csv", "x,y\n0,7\n10,7\n"};
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    ASSERT_EQ(imported.scene.at("section").at("regions").size(), 2u);
    EXPECT_NEAR(area_of(region(imported.scene, "TAILINGS_0_2")), 20.3, 0.31);
}

TEST(Import, EveryFaultOfADrawingIsFoundAtOnceAndNothingIsMade) {
    const std::string bad =
        light("ROCK", test::rock) +
        light("CLAY", {{20, 0}, {80, 0}, {55, 12}, {50, 12}, {22, 1}}, false) +  // open
        light("TAILINGS", {{0, 0}, {20, 0}, {55, 10}, {0, 11}}) +                // overlaps
        light("DRAIN", {{60, 0}, {70, 0}, {70, 2}}) +                            // no material
        light("CLAY", {{90, 0}, {100, 5}, {100, 0}, {90, 5}}) +                  // crosses itself
        test::group(0, "SPLINE") + test::group(8, "CLAY") + test::group(10, 30.0) +
        test::group(20, 8.0);
    const Imported imported = import_section(test::request(dxf(bad)));
    EXPECT_TRUE(imported.scene.is_null());
    const std::string told = test::told(imported.faults);
    for (const char* each :
         {"is open: its ends (20, 0) and (22, 1) are 2.24 m apart",
          "CLAY_1 and TAILINGS overlap at", "layer DRAIN has no material: 1 entity",
          "crosses itself at (95, 2.5)", "SPLINE on layer CLAY at (30, 8)"})
        EXPECT_NE(told.find(each), std::string::npos) << each << "\n" << told;
    EXPECT_EQ(imported.faults.size(), 5u) << told;
    for (const fault::Fault& each : imported.faults) {
        EXPECT_EQ(each.pointer.rfind("line ", 0), 0u) << each.pointer;
        EXPECT_FALSE(each.remedy.empty());
    }
    EXPECT_EQ(imported.sketch.section.regions.size(), 4u);
}

/// The example in the folder's README.
Imported example(const std::string& file) {
    const std::filesystem::path folder = BREACH_ROOT "/services/import/example";
    const auto bytes = [&](const std::string& name) {
        std::ifstream stream(folder / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    return import_section({.drawing = {file, bytes(file)},
                           .materials = json::parse(bytes("materials.json")),
                           .layers = {"TAILINGS=5,10"}});
}

TEST(Import, TheExamplesAreWhatTheirPageSays) {
    const Imported sound = example("dam.dxf");
    EXPECT_EQ(test::told(sound.faults), "");
    ASSERT_FALSE(sound.scene.is_null());
    EXPECT_EQ(sound.scene.at("section").at("regions").size(), 7u);
    EXPECT_EQ(sound.report.at("healed").size(), 12u);
    EXPECT_EQ(example("faulty.dxf").faults.size(), 10u);
}

TEST(Import, MillimetresReadAsMetresAreRefused) {
    const auto scaled = [](Line ring) {
        for (Vec2& each : ring) each *= 250.0;
        return ring;
    };
    const Imported imported = import_section(test::request(dxf(light("ROCK", scaled(test::rock)))));
    ASSERT_EQ(imported.faults.size(), 1u);
    EXPECT_NE(imported.faults[0].cause.find("it is 3e+04 m long, as if millimetres"),
              std::string::npos)
        << imported.faults[0].cause;
    EXPECT_NE(imported.faults[0].remedy.find("with mm it is 30 m"), std::string::npos);
}

TEST(Import, TheReportBeginsWithTheUnitItsSourceAndTheSizeThatCameOfIt) {
    const auto first_line = [](const Request& request) {
        const Imported imported = import_section(request);
        EXPECT_EQ(test::told(imported.faults), "");
        return lines_of(imported.report, 5).at(0);
    };
    const std::string slope = light("CLAY", {{0, 0}, {150, 0}, {70, 26}, {0, 26}});
    EXPECT_EQ(first_line(test::request(dxf(slope, 2))),
              "read in ft (the drawing's $INSUNITS): the section is 45.7 m long and 7.92 m high");
    Request asked = test::request(dxf(slope, 2));
    asked.unit = "m";
    EXPECT_EQ(first_line(asked), "read in m (as asked): the section is 150 m long and 26 m high");
    const std::string table = "region,x,y\nclay,0,0\nclay,1500,0\nclay,700,260\nclay,0,260\n";
    EXPECT_EQ(first_line(test::request(table, "dam.csv")),
              "read in m (metres, as nothing says otherwise): the section is 1500 m long and 260 m "
              "high");
    const Imported imported = import_section(test::request(table, "dam.csv"));
    EXPECT_EQ(imported.report.at("unit_from"), "default");
    EXPECT_EQ(imported.report.at("size"), json::parse("[1500.0, 260.0]"));
}

TEST(Import, AHeaderSaysTheUnitOfItsTable) {
    const auto table = [](const std::string& header) {
        return test::request(header + "\nclay,0,0\nclay,150,0\nclay,70,26\nclay,0,26\n", "dam.csv");
    };
    for (const char* header : {"region,x_ft,y_ft", "region,x (ft),y (ft)",
                               "region,X [feet],Y [feet]", "region,x ft,z ft"}) {
        const Imported imported = import_section(table(header));
        EXPECT_EQ(test::told(imported.faults), "") << header;
        EXPECT_EQ(lines_of(imported.report, 5).at(0),
                  "read in ft (the table's header): the section is 45.7 m long and 7.92 m high");
    }
    Request asked = table("region,x_m,y_m");
    asked.unit = "m";
    EXPECT_EQ(import_section(asked).report.at("size"), json::parse("[150.0, 26.0]"));
    asked.unit = "ft";
    const auto told = [](const Request& request) {
        return test::told(import_section(request).faults);
    };
    EXPECT_NE(
        told(asked).find("the header says that x and y are in m, and the unit asked for is ft"),
        std::string::npos)
        << told(asked);
    EXPECT_NE(told(table("region,x_ft,y_m")).find("x in ft and y in m"), std::string::npos);
    EXPECT_NE(told(table("region,x_ft,y")).find("x in ft and y without a unit"), std::string::npos);
    EXPECT_NE(told(table("region,x (rod),y (rod)")).find("\"rod\" in the header is no unit"),
              std::string::npos);
    EXPECT_EQ(told(table("region,x,y,x_offset")), "");
    Request both = table("region,x_ft,y_ft");
    both.phreatic = {"water.csv", "x_m,y_m\n0,5\n45,0\n"};
    const Imported imported = import_section(both);
    EXPECT_EQ(imported.scene.at("lem").at("water").at("line"),
              json::parse("[[0.0,5.0],[45.0,0.0]]"));
    EXPECT_EQ(imported.report.at("remarks").dump().find("water.csv was read"), std::string::npos);
}

TEST(Import, AFaultNamesTheEncodingOfAWideText) {
    const std::string utf16("\xFF\xFEr\0e\0", 6);
    EXPECT_EQ(test::told(import_section(test::request(utf16, "dam.csv")).faults),
              "line 1: is UTF-16 text | save it as UTF-8 (iconv -f UTF-16 -t UTF-8 FILE)\n");
}

TEST(Import, ALineInAnotherUnitThanTheDrawingIsReported) {
    Request request = test::request(dxf(light("CLAY", {{0, 0}, {150, 0}, {70, 26}, {0, 26}}), 2));
    request.phreatic = {"water.csv", "x,y\n0,5\n45,0\n"};
    const auto remarks = [](const Request& asked) {
        return import_section(asked).report.at("remarks").dump();
    };
    EXPECT_NE(remarks(request).find("water.csv was read in m because it names no unit, the drawing "
                                    "in ft"),
              std::string::npos)
        << remarks(request);
    request.unit = "ft";
    EXPECT_EQ(remarks(request).find("water.csv was read"), std::string::npos);
}

TEST(Import, TheTerrainMakesARunoutThatIsChecked) {
    Request request =
        test::request(dxf(light("CLAY", test::clay) + light("TAILINGS", test::tailings)));
    request.terrain = {"terrain.csv", "x,y\n0,0\n80,0\n300,-6\n"};
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(imported.scene.at("mpm").at("runout").at("toe"), json::parse("[80.0,0.0]"));
    EXPECT_EQ(imported.scene.at("mpm").at("domain_x"), json::parse("[0.0,300.0]"));
    // A centimetre above the section's base: the soil counts as lying on it.
    request.terrain->bytes = "x,y\n0,0\n50,0.01\n80,-0.01\n300,-6\n";
    const Imported healed = import_section(request);
    ASSERT_EQ(test::told(healed.faults), "");
    const scene::Scene scene = scene::parse_scene(healed.scene.dump(), "scene");
    for (const scene::Region& each : scene.section.regions)
        for (const Vec2& vertex : each.polygon)
            EXPECT_GE(vertex.y(), geometry::level_at(scene.mpm->terrain, vertex.x()) - 1e-9);
    request.terrain->bytes = "x,y\n-0.7,0\n80,0\n300.5,-6\n";
    const json grid = import_section(request).scene.at("mpm").at("domain_x");
    EXPECT_EQ(grid, json::parse("[0.0,300.6]")) << "its wall touches the section";
    request.terrain->bytes = "x,y\n0,3\n300,-6\n";
    const Imported cut = import_section(request);
    EXPECT_NE(test::told(cut.faults).find("/mpm/terrain: passes through region"), std::string::npos)
        << test::told(cut.faults);
}

TEST(Import, MaterialsOfASceneKeepTheLengthThatTheirSofteningHoldsFor) {
    Request request =
        test::request(dxf(light("CLAY", test::clay) + light("TAILINGS", test::tailings)));
    request.terrain = {"terrain.csv", "x,y\n0,0\n80,0\n300,-6\n"};
    json& tailings = request.materials["tailings"];
    tailings["law"]["softening"] = {{"epsilon_q_start", 0.01},
                                    {"epsilon_q_end", 1.0},
                                    {"c_residual_kPa", 1},
                                    {"phi_residual_deg", 10}};
    tailings["nonlocal_length"] = 10.0;
    const auto length = [&] {
        const Imported imported = import_section(request);
        EXPECT_EQ(test::told(imported.faults), "");
        const json mpm = imported.scene.is_null() ? json::object() : imported.scene.at("mpm");
        return std::pair(mpm.value("softening_length", 0.0), mpm.value("cell_size", 1.0));
    };
    const auto [guessed, cell] = length();
    EXPECT_EQ(guessed, cell);
    request.materials = {{"materials", request.materials}, {"mpm", {{"softening_length", 0.7}}}};
    EXPECT_EQ(length().first, 0.7);
}

TEST(Import, AGapThatIsOpenToASideIsFoundAlsoUnderLevelGround) {
    const Imported imported =
        import_section(test::request(dxf(light("ROCK", {{0, 0}, {30, 0}, {30, 4}, {0, 4}}) +
                                         light("CLAY", {{0, 4.3}, {30, 4.7}, {30, 9}, {0, 9}}))));
    ASSERT_EQ(imported.faults.size(), 1u) << test::told(imported.faults);
    EXPECT_NE(imported.faults[0].cause.find("air below CLAY at (15, 4.25): it stands 0.5 m above"),
              std::string::npos)
        << imported.faults[0].cause;
}

TEST(Import, InvalidOptionsAreReportedWithValidOnes) {
    Request request = test::request(dxf(section()));
    request.map = {"CLAY", "ROCK=granite", "SHELL=clay"};
    request.layers = {"TAILINGS=5"};
    const std::string told = test::told(import_section(request).faults);
    for (const char* each : {"\"CLAY\" maps nothing", "there is no material \"granite\"",
                             "nothing is drawn on layer \"shell\""})
        EXPECT_NE(told.find(each), std::string::npos) << each << "\n" << told;
    request.map = {};
    EXPECT_NE(test::told(import_section(request).faults).find("there is no phreatic line"),
              std::string::npos);
    request.materials = json::array();
    request.tolerance = -1;
    request.unit = "furlong";
    EXPECT_EQ(import_section(request).faults.size(), 3u);
}

TEST(Import, PolygonsInATableAreTheSameSection) {
    std::string table = "region,x,y\n";
    for (const auto& [name, ring] : std::map<std::string, Line>{
             {"rock", test::rock}, {"clay", test::clay}, {"tailings", test::tailings}})
        for (const Vec2& each : ring)
            table += name + "," + std::to_string(each.x()) + "," + std::to_string(each.y()) + "\n";
    const Imported imported = import_section(test::request(table, "dam.csv"));
    ASSERT_EQ(test::told(imported.faults), "");
    const Imported drawn = import_section(test::request(dxf(section())));
    for (const char* name : {"rock", "clay", "tailings"}) {
        std::string layer = name;
        for (char& each : layer) each = static_cast<char>(each - 32);
        EXPECT_EQ(area_of(region(imported.scene, name)), area_of(region(drawn.scene, layer)));
    }
    EXPECT_EQ(imported.scene.at("lem"), drawn.scene.at("lem"));
}

// A dam of 30 m whose face ends at (200, 100); the ground beyond falls by 2 %.
const Line falling_ground{{0, 90}, {400, 86}, {400, 96}, {200, 100}, {0, 100}};
const Line dam_on_it{{0, 100}, {200, 100}, {164, 112}, {156, 112}, {110, 130}, {0, 129}};

TEST(Import, TheToeIsWhereTheFaceEndsThoughTheGroundFallsOn) {
    const std::string drawn = light("ROCK", falling_ground) + light("TAILINGS", dam_on_it);
    for (const double way : {1.0, -1.0}) {
        const auto turned = [&](Line ring) {
            for (Vec2& each : ring) each.x() *= way;
            return ring;
        };
        const Imported imported = import_section(test::request(
            dxf(light("ROCK", turned(falling_ground)) + light("TAILINGS", turned(dam_on_it)))));
        ASSERT_EQ(test::told(imported.faults), "");
        EXPECT_EQ(imported.report.at("slope").at("toe"), json({way * 200.0, 100.0}));
        EXPECT_EQ(imported.report.at("slope").at("crest"), json({way * 110.0, 130.0}));
        const json exit = imported.scene.at("lem").at("search").at("exit");
        EXPECT_LT(std::min(way * exit[0].get<double>(), way * exit[1].get<double>()), 160.0);
        EXPECT_GT(std::max(way * exit[0].get<double>(), way * exit[1].get<double>()), 210.0);
        EXPECT_LT(std::max(way * exit[0].get<double>(), way * exit[1].get<double>()), 250.0);
    }
    Request request = test::request(dxf(drawn));
    request.terrain = {"terrain.csv", "x,y\n0,90\n400,86\n400.5,96\n800,88\n"};
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    const json& mpm = imported.scene.at("mpm");
    EXPECT_EQ(mpm.at("runout").at("toe"), json({200.0, 100.0}));
    EXPECT_EQ(mpm.at("runout").at("regions"), json({"TAILINGS"}));
    EXPECT_EQ(mpm.at("fill_points"), 4);
    EXPECT_EQ(mpm.at("overlap_correction").at("rate"), 5);
    EXPECT_EQ(mpm.at("floor").at("friction").at(0).at("from"), mpm.at("domain_x").at(0));
    EXPECT_EQ(mpm.at("floor").at("friction").at(0).at("to"), mpm.at("domain_x").at(1));
}

TEST(Import, ASlopeThatIsTooLowToBeOneIsAskedForWithItsSizeInOtherUnits) {
    // Drawn in metres, and the file says inches: 12 m become 0.3 m.
    const std::string drawn =
        light("ROCK", test::rock) + light("CLAY", test::clay) + light("TAILINGS", test::tailings);
    Request request = test::request(dxf(drawn, 1));
    const Imported asked = import_section(request);
    ASSERT_EQ(asked.faults.size(), 1u) << test::told(asked.faults);
    EXPECT_EQ(asked.to_confirm.size(), 1u);
    EXPECT_TRUE(asked.scene.is_null());
    EXPECT_EQ(asked.faults[0].pointer, "unit");
    for (const char* each : {"is 0.305 m high only, read in in", "120 m by 22 m in m",
                             "1.2 m by 0.22 m in cm", "36.6 m by 6.71 m in ft"})
        EXPECT_NE(asked.faults[0].cause.find(each), std::string::npos) << asked.faults[0].cause;
    request.confirmed = true;
    EXPECT_EQ(test::told(import_section(request).faults), "");
    request.confirmed = false;
    request.unit = "m";
    EXPECT_EQ(test::told(import_section(request).faults), "");
}

TEST(Import, SwappedAxesAndDepthsForLevelsAreAskedFor) {
    const auto cause = [](auto change) {
        const auto changed = [&](Line ring) {
            for (Vec2& each : ring) each = change(each);
            return ring;
        };
        const Imported imported = import_section(test::request(
            dxf(light("ROCK", changed(test::rock)) + light("CLAY", changed(test::clay)) +
                light("TAILINGS", changed(test::tailings)) +
                light("PHREATIC", changed({{0, 9}, {40, 8}, {80, 0}, {120, 0}}), false))));
        EXPECT_EQ(test::told(imported.faults), test::told(imported.to_confirm));
        return test::told(imported.to_confirm);
    };
    EXPECT_EQ(cause([](const Vec2& v) { return v; }), "");
    EXPECT_NE(cause([](const Vec2& v) { return Vec2(v.y(), v.x()); })
                  .find("the section is 22 m long and 120 m high: x and y look swapped, or the "
                        "levels exaggerated"),
              std::string::npos);
    EXPECT_NE(cause([](const Vec2& v) {
                  return Vec2(v.x(), 12.0 - v.y());
              }).find("looks as if depths were given as levels"),
              std::string::npos);
}

TEST(Import, CellsFitTheLayersThatItCutsItself) {
    const auto cell = [](const std::string& layers) {
        Request request =
            test::request(dxf(light("ROCK", falling_ground) + light("TAILINGS", dam_on_it) +
                              light("PHREATIC", {{0, 127}, {110, 120}, {200, 100}}, false)));
        request.terrain = {"terrain.csv", "x,y\n0,90\n400,86\n400.5,96\n800,88\n"};
        request.layers = {layers};
        for (const char* part : {"TAILINGS_0_3", "TAILINGS_3_6", "TAILINGS_0_0p3"}) {
            request.materials[part] = request.materials["tailings"];
            request.materials[part]["law"]["c_kPa"] = part[9] == '3' ? 5 : 8;
        }
        const Imported imported = import_section(request);
        EXPECT_EQ(test::told(imported.faults), "");
        return imported.scene.at("mpm");
    };
    EXPECT_EQ(cell("TAILINGS=20").at("cell_size"), 1.5);
    EXPECT_EQ(cell("TAILINGS=3,6").at("cell_size"), 0.75);
    EXPECT_EQ(cell("TAILINGS=0.3").at("allow_coarse_cells"), true);
}

TEST(Import, TheCrestStaysWhereItIsDrawnWhenLayersAreCutBelowIt) {
    // The line crosses the dam's inner face half a metre downstream of the crest.
    Request request =
        test::request(dxf(light("CLAY", {{62, 0}, {80, 0}, {55, 12}, {50, 12}}) +
                          light("TAILINGS", {{0, 0}, {62, 0}, {50, 12}, {0, 11}}) +
                          light("PHREATIC", {{0, 10.5}, {55.5, 6.5}, {80, 0}}, false)));
    for (const char* layers : {"", "TAILINGS=4"}) {
        if (*layers) request.layers = {layers};
        const Imported imported = import_section(request);
        ASSERT_EQ(test::told(imported.faults), "");
        EXPECT_EQ(imported.report.at("slope").at("crest"), json::parse("[55.0, 12.0]")) << layers;
    }
}

TEST(Import, NamesOfMaterialsAndRegionsMatchInAnyCase) {
    Request request = test::request(dxf(light("TAILINGS", {{0, 0}, {20, 0}, {20, 8}, {0, 8}}) +
                                        light("CORE", {{20, 0}, {40, 0}, {20, 8}}) +
                                        light("PHREATIC", {{0, 7}, {20, 6}}, false)));
    request.layers = {"Tailings=3"};
    request.map = {"core=CLAY"};
    request.materials["tailings_0_3"] = request.materials["tailings"];
    const Imported imported = import_section(request);
    ASSERT_EQ(test::told(imported.faults), "");
    EXPECT_EQ(region(imported.scene, "TAILINGS_0_3").at("material"), "tailings_0_3");
    EXPECT_EQ(region(imported.scene, "TAILINGS_below_3").at("material"), "tailings");
    EXPECT_EQ(region(imported.scene, "CORE").at("material"), "clay");
}

}  // namespace
}  // namespace breach::importing::import_test
