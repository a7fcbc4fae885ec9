// `breach mirror`: every x of a scene turns, and nothing else.
#include "services/cli/mirror.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "core/scene/scene.hpp"

namespace breach::cli {
namespace {

using nlohmann::ordered_json;

std::vector<std::filesystem::path> shipped_scenes() {
    std::vector<std::filesystem::path> scenes;
    for (const auto& each :
         std::filesystem::directory_iterator(std::string(BREACH_ROOT) + "/workflows/scenes"))
        scenes.push_back(each.path());
    return scenes;
}

ordered_json read(const std::filesystem::path& file) {
    std::ifstream from(file);
    return ordered_json::parse(from);
}

TEST(Mirror, TwiceIsTheSameSceneForEveryShippedOne) {
    std::size_t turned = 0;
    for (const std::filesystem::path& file : shipped_scenes()) {
        const ordered_json scene = read(file);
        if (scene.contains(ordered_json::json_pointer("/transfer/liquefied/line"))) continue;
        const ordered_json once = mirrored(scene, file.string());
        const auto sorted = [](const ordered_json& each) {
            return nlohmann::json::parse(each.dump());
        };
        EXPECT_NE(once, scene) << file;
        nlohmann::json twice = sorted(mirrored(once, file.string()));
        if (scene.contains("mpm"))  // both sides are explicit now
            for (const char* side : {"left", "right"})
                if (!scene["mpm"].contains(side)) twice["mpm"].erase(side);
        EXPECT_EQ(twice, sorted(scene)) << file;
        ++turned;
    }
    EXPECT_GT(turned, 7U);
}

TEST(Mirror, GivesASoundSceneOfTheSameAreas) {
    for (const std::filesystem::path& file : shipped_scenes()) {
        const ordered_json scene = read(file);
        if (scene.contains(ordered_json::json_pointer("/transfer/liquefied/line"))) continue;
        const auto before = scene::parse_scene(scene.dump(), "drawn", file.parent_path());
        ordered_json turned = mirrored(scene, file.string());
        if (turned.contains("mpm"))  // of the other face: the user's to give
            turned["mpm"]["runout"]["toe"] = {turned["mpm"]["domain_x"][1], 0};
        const auto after = scene::parse_scene(turned.dump(), "mirrored", file.parent_path());
        for (std::size_t r = 0; r < before.section.regions.size(); ++r)
            EXPECT_NEAR(geometry::signed_area(before.section.regions[r].polygon),
                        geometry::signed_area(after.section.regions[r].polygon), 1e-6)
                << file << " " << r;
    }
}

// A number of the schema that lies along x and is not in the table would stay where it was.
TEST(Mirror, TurnsEveryPointThatTheSchemaKnows) {
    const ordered_json scene = ordered_json::parse(R"({
        "section": {"regions": [{"polygon": [[1, 2], [3, 2], [3, 4], [1, 2]],
            "mesh": {"corners": [[1, 2], [3, 2]], "graded": {"left_of": 1, "right_of": 3}}}]},
        "lem": {"circle": {"center": [1, 2]}, "search": {"entry": [1, 3], "exit": [4, 6]},
            "floor": [[1, 2], [3, 4]], "non_circular": {"given": [[1, 2], [3, 4]]},
            "water": {"line": [[1, 2], [3, 4]]}, "piezometric_lines": [{"line": [[1, 2], [3, 4]]}],
            "surcharge": [{"from": 1, "to": 3}]},
        "fem": {"supports": [{"from": [1, 2], "to": [3, 2]}], "crest": [1, 2],
            "water": {"line": [[1, 2], [3, 4]], "boundaries": [{"from": [1, 2], "to": [3, 2]}]},
            "surcharge": [{"from": 1, "to": 3}], "free_field": {"sides": "left"},
            "liquefaction": {"x": [1, 3]}, "motion": {"file": "a"},
            "stages": [{"surcharge": [{"from": 1, "to": 3}], "phreatic_line": [[1, 2], [3, 4]],
                "displace": [{"from": [1, 2], "to": [3, 2], "x": 1, "y": 1}],
                "pressures": [{"from": [1, 2], "to": [3, 2]}]}]},
        "transfer": {"phreatic_line": [[1, 2], [3, 4]]},
        "mpm": {"domain_x": [1, 3], "left": "open", "right": "roller", "terrain": [[1, 2], [3, 4]],
            "floor": {"level": 1, "friction": [{"from": 1, "to": 2}, {"from": 2, "to": 3}]},
            "water": {"line": [[1, 2], [3, 4]]}, "runout": {"toe": [1, 2]},
            "gauges": [{"x": 1}], "sections": [{"x": 1}]}})");
    const ordered_json turned = mirrored(scene, "scene");
    const std::string text = turned.dump();
    EXPECT_FALSE(std::regex_search(text, std::regex(R"-("(x|from|left_of|right_of)":[0-9])-")))
        << text;
    EXPECT_FALSE(std::regex_search(text, std::regex(R"(\[[1-9]\d*,)"))) << text;
    EXPECT_EQ(turned["mpm"]["floor"]["friction"][0]["from"], -3);
    EXPECT_EQ(turned["mpm"]["left"], "roller");
    EXPECT_EQ(turned["fem"]["free_field"]["sides"], "right");
    EXPECT_EQ(turned["fem"]["stages"][0]["displace"][0]["y"], 1);
    EXPECT_EQ(turned["fem"]["motion"]["reversed"], true);
    ordered_json lined = scene;
    lined["transfer"]["liquefied"]["line"] = ordered_json::array();
    EXPECT_THROW(mirrored(lined, "scene"), fault::BadInput);
}

}  // namespace
}  // namespace breach::cli
