// The drawing of a section: every region once in its colour, everything within the page, faults at
// their places, distinguishable colours.
#include "services/drawing/section_drawing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "core/scene/reading.hpp"
#include "core/scene/schema.hpp"
#include "services/drawing/palette.hpp"

namespace breach::drawing {
namespace {

using nlohmann::json;

const std::filesystem::path scenes = BREACH_ROOT "/workflows/scenes";

json shipped(const std::string& name) {
    const auto file = scenes / (name + ".json");
    return scene::parse_json(scene::text_of(file), name);
}

Draft draft_of_scene(const json& document, const std::vector<std::string>& overrides = {}) {
    BaseScene base{document, overrides, ""};
    check::Checked checked = check::checked_text(document.dump(), "scene", scenes, overrides);
    return draft_of(std::move(base), std::move(checked));
}

std::string drawn(const std::string& name, const std::vector<std::string>& overrides = {}) {
    return as_svg(draft_of_scene(shipped(name), overrides), {});
}

/// All matches with their groups.
std::vector<std::vector<std::string>> all(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::vector<std::vector<std::string>> found;
    for (std::sregex_iterator at(text.begin(), text.end(), wanted), end; at != end; ++at)
        found.emplace_back(at->begin(), at->end());
    return found;
}

std::size_t count(const std::string& svg, const std::string& name) {
    return all(svg, "class=\"" + name + "\"").size();
}

const std::string region =
    "<path d=\"([^\"]*)\" fill=\"(#[0-9a-f]{6})\" class=\"region\" data-region=\"([^\"]*)\" "
    "data-material=\"([^\"]*)\"";

std::vector<mechanics::Vec2> points_of(const std::string& path) {
    std::vector<mechanics::Vec2> points;
    for (const auto& each : all(path, "[ML](-?[0-9.e+]+) (-?[0-9.e+]+)"))
        points.emplace_back(std::stod(each[1]), std::stod(each[2]));
    return points;
}

TEST(SectionDrawing, HasEveryRegionOnceInItsMaterialsColour) {
    for (const char* name : {"column", "slope", "mochikoshi", "mochikoshi_runout"}) {
        const json document = shipped(name);
        std::map<std::string, std::string> materials, colours;
        for (const auto& each : all(drawn(name), region)) {
            EXPECT_TRUE(materials.emplace(each[3], each[4]).second) << name << ": " << each[3];
            EXPECT_EQ(colours.emplace(each[4], each[2]).first->second, each[2]) << each[4];
        }
        ASSERT_EQ(materials.size(), document["section"]["regions"].size()) << name;
        for (const json& each : document["section"]["regions"])
            EXPECT_EQ(materials.at(each["name"]), each["material"]);
        std::set<std::string> distinct;
        for (const auto& [material, colour] : colours) distinct.insert(colour);
        EXPECT_EQ(distinct.size(), colours.size()) << name;
    }
}

TEST(SectionDrawing, HasOneScaleInXAndY) {
    for (const auto& each : all(drawn("slope"), region)) {
        if (each[3] != "slope") continue;  // (0, 0), (30, 0), (20, 10), (0, 10)
        const auto corners = points_of(each[1]);
        ASSERT_GE(corners.size(), 4u);
        const double of_x = (corners[1].x() - corners[0].x()) / 30.0;
        EXPECT_NEAR((corners[2].x() - corners[0].x()) / 20.0, of_x, 0.02);
        EXPECT_NEAR((corners[0].y() - corners[2].y()) / 10.0, of_x, 0.02);
        return;
    }
    FAIL() << "the region is not there";
}

TEST(SectionDrawing, DrawsNothingOutsideThePage) {
    for (const char* name : {"column", "slope", "mochikoshi", "mochikoshi_runout"}) {
        const std::string svg = drawn(name, {"/mpm/runout/toe=[5000,0]"});  // a fault far away, too
        const auto size = all(svg, "viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"").at(0);
        const double width = std::stod(size[1]), height = std::stod(size[2]);
        const auto on_page = [&](double x, double y) {
            EXPECT_TRUE(x >= 0.0 && x <= width && y >= 0.0 && y <= height)
                << name << ": (" << x << ", " << y << ") of " << width << " x " << height;
        };
        for (const auto& each : all(svg, region))
            for (const auto& point : points_of(each[1])) on_page(point.x(), point.y());
        for (const auto& each : all(svg, "<circle cx=\"([^\"]*)\" cy=\"([^\"]*)\""))
            on_page(std::stod(each[1]), std::stod(each[2]));
        for (const auto& each : all(svg, "<text x=\"([^\"]*)\" y=\"([^\"]*)\""))
            on_page(std::stod(each[1]), std::stod(each[2]));
    }
}

TEST(SectionDrawing, LabelsDoNotLieOnEachOther) {
    struct Box {
        double left, right, y;
        std::string text;
    };
    for (const char* name : {"column", "slope", "mochikoshi"}) {
        std::vector<Box> boxes;
        for (const auto& each :
             all(drawn(name),
                 "<text x=\"([^\"]*)\" y=\"([^\"]*)\" class=\"label\"[^>]*>([^<]*)<")) {
            const double x = std::stod(each[1]), half = 3.2 * static_cast<double>(each[3].size());
            boxes.push_back({x - half, x + half, std::stod(each[2]), each[3]});
        }
        EXPECT_GE(boxes.size(), 3u) << name;
        for (std::size_t i = 0; i < boxes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Box &a = boxes[i], &b = boxes[j];
                const bool apart =
                    a.right <= b.left || b.right <= a.left || std::abs(a.y - b.y) >= 13.0;
                EXPECT_TRUE(apart) << name << ": " << a.text << " lies on " << b.text;
            }
    }
}

TEST(SectionDrawing, ShowsWhatTheSceneHasAndNothingElse) {
    const std::string dam = drawn("mochikoshi"), column = drawn("column");
    for (const char* name : {"phreatic", "search", "base", "free-field", "gauge", "terrain"}) {
        EXPECT_GT(count(dam, name), 0u) << name;
        EXPECT_EQ(count(column, name), 0u) << name;
    }
    for (const std::string* each : {&dam, &column})
        for (const char* name : {"support", "crest", "toe", "mpm-grid"})
            EXPECT_GT(count(*each, name), 0u) << name;
    EXPECT_NE(dam.find("PGA 0.3 g"), std::string::npos);
    EXPECT_NE(dam.find("Arias intensity 1.33 m/s"), std::string::npos);
    EXPECT_EQ(column.find("Arias"), std::string::npos);
    json only_soil = shipped("column");
    for (const char* part : {"fem", "transfer", "mpm"}) only_soil.erase(part);
    const std::string soil = as_svg(draft_of_scene(only_soil), {});
    for (const char* name : {"support", "crest", "toe", "mpm-grid"})
        EXPECT_EQ(count(soil, name), 0u);
    EXPECT_EQ(count(soil, "region"), 1u);
}

TEST(SectionDrawing, ShowsWhatLiquefiesWhereItCracksAndWherePressureIsHeld) {
    const std::string held =
        "/fem/water/boundaries=[{\"name\": \"drain\", \"from\": [220, 0], \"to\": [280, 0], "
        "\"level\": 1}]";
    const std::string dam = drawn("mochikoshi", {"/lem/tension_crack={\"depth\": 3}", held});
    EXPECT_EQ(count(dam, "liquefaction"), 5u);
    EXPECT_NE(dam.find("LEM: liquefies in stages 1 to 5"), std::string::npos);
    EXPECT_GT(count(dam, "crack"), 0u);
    EXPECT_NE(dam.find("tension crack, 3 m deep"), std::string::npos);
    EXPECT_EQ(count(dam, "pressure"), 1u);
    EXPECT_NE(dam.find("pore pressure held on drain, water at y = 1 m"), std::string::npos);
    for (const char* name : {"liquefaction", "crack", "pressure"})
        EXPECT_EQ(count(drawn("slope"), name), 0u) << name;
}

TEST(SectionDrawing, WaterAboveTheGroundIsSeen) {
    const std::string ponded =
        drawn("mochikoshi", {"/lem/water/line=[[-40,32],[60,32],[100,25],[280,0]]"});
    EXPECT_EQ(count(drawn("slope"), "water"), 0u);
    EXPECT_GT(count(ponded, "water"), 0u);
}

TEST(SectionDrawing, DrawsAMeshOnceItIsThere) {
    Additions additions;
    additions.mesh = DrawnMesh{{{0, 0}, {10, 0}, {10, 20}, {0, 20}}, {{0, 1, 2, 3}}};
    const std::string svg = as_svg(draft_of_scene(shipped("column")), additions);
    EXPECT_EQ(count(svg, "mesh"), 1u);
    EXPECT_NE(svg.find("mesh of 1 elements, 4 nodes"), std::string::npos);
}

/// Pointers and numbers of the red marks.
std::map<std::string, mechanics::Vec2> marks_of(const std::string& svg) {
    std::map<std::string, mechanics::Vec2> marks;
    for (const auto& each :
         all(svg,
             "<g class=\"fault\" data-pointer=\"([^\"]*)\">\n(?:<path[^>]*>\n)*<circle "
             "cx=\"([^\"]*)\" cy=\"([^\"]*)\""))
        marks[each[1]] = {std::stod(each[2]), std::stod(each[3])};
    return marks;
}

TEST(SectionDrawing, FaultsAreMarkedWhereTheyAreAndListed) {
    const Draft draft = draft_of_scene(
        shipped("slope"), {"/fem/crest=[70,12]", "/materials/slope_soil/density=-5", "/mpm/cfl=7"});
    ASSERT_EQ(draft.faults.size(), 3u);
    const std::string svg = as_svg(draft, {});
    const auto marks = marks_of(svg);
    ASSERT_EQ(marks.count("/fem/crest"), 1u);
    const auto base = points_of(all(svg, region).at(0)[1]);  // from (0, -5)
    const double scale = (base[2].x() - base[0].x()) / 60.0;
    EXPECT_NEAR(marks.at("/fem/crest").x(), base[0].x() + 70.0 * scale, 1.0);
    EXPECT_NEAR(marks.at("/fem/crest").y(), base[0].y() - 17.0 * scale, 1.0);
    EXPECT_EQ(marks.count("/materials/slope_soil/density"), 1u);
    EXPECT_EQ(marks.count("/mpm/cfl"), 0u);  // has no place, and is listed
    EXPECT_EQ(all(svg, "data-cause=").size(), 3u);
    EXPECT_NE(svg.find("data-pointer=\"/mpm/cfl\" data-cause"), std::string::npos);
}

TEST(SectionDrawing, APolygonThatIsNoneIsDrawnAsItsFault) {
    const Draft draft = draft_of_scene(
        shipped("column"),
        {"/section/regions/0/polygon=[[0,0],[10,20],[10,0],[0,20],[0,0]]"});  // crosses itself
    ASSERT_FALSE(draft.faults.empty());
    ASSERT_TRUE(can_be_drawn(draft));
    const std::string svg = as_svg(draft, {});
    EXPECT_EQ(count(svg, "region"), 0u);
    EXPECT_EQ(marks_of(svg).count("/section/regions/0/polygon"), 1u) << svg;
}

TEST(SectionDrawing, CannotBeDrawnWithoutAnyPlace) {
    const Draft draft = draft_of_scene(json{{"format", "breachline-scene/1"}, {"name", "empty"}});
    EXPECT_FALSE(can_be_drawn(draft));
    EXPECT_FALSE(draft.faults.empty());
}

TEST(SectionDrawing, TakesAStudysBaseScene) {
    const json study{{"scene", shipped("column")}, {"overrides", {"/mpm/cell_size=0.5", 7}}};
    const BaseScene base = base_scene_of(study);
    EXPECT_EQ(base.pointer, "/scene");
    EXPECT_EQ(base.overrides, std::vector<std::string>{"/mpm/cell_size=0.5"});
    EXPECT_THROW(base_scene_of(json{{"scene", "scene.json"}}), fault::BadInput);
}

TEST(SectionDrawing, WordsOfASceneAreNoMarkup) {
    json scene = shipped("column");
    scene["title"] = "</svg><script>alert(1)</script>";
    const std::string svg = as_svg(draft_of_scene(scene), {});
    EXPECT_EQ(svg.find("<script"), std::string::npos);
}

// ---------------------------------------------------------------- colours

using Triple = std::array<double, 3>;

Triple linear(const std::string& colour) {
    Triple rgb{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double v = std::stoi(colour.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
        rgb[k] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return rgb;
}

/// CIE L* of a colour printed in grey.
double grey(const Triple& rgb) {
    const double Y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    return Y > 0.008856 ? 116.0 * std::cbrt(Y) - 16.0 : 903.3 * Y;
}

using Matrix = std::array<Triple, 3>;
// Machado, Oliveira & Fernandes (2009), severity 1.
constexpr Matrix everyone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix protanope{{{0.152286, 1.052583, -0.204868},
                            {0.114503, 0.786281, 0.099216},
                            {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix deuteranope{{{0.367322, 0.860646, -0.227968},
                              {0.280085, 0.672501, 0.047413},
                              {-0.011820, 0.042940, 0.968881}}};

Triple oklab(const Triple& rgb, const Matrix& eye) {
    Triple seen{};
    for (std::size_t i = 0; i < 3; ++i)
        seen[i] =
            std::clamp(eye[i][0] * rgb[0] + eye[i][1] * rgb[1] + eye[i][2] * rgb[2], 0.0, 1.0);
    const double l =
        std::cbrt(0.4122214708 * seen[0] + 0.5363325363 * seen[1] + 0.0514459929 * seen[2]);
    const double m =
        std::cbrt(0.2119034982 * seen[0] + 0.6806995451 * seen[1] + 0.1073969566 * seen[2]);
    const double s =
        std::cbrt(0.0883024619 * seen[0] + 0.2817188376 * seen[1] + 0.6299787005 * seen[2]);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double distance(const Triple& a, const Triple& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(SectionColours, StayApartInGreyAndForTheColourBlind) {
    for (std::size_t i = 0; i < fills.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Triple a = linear(fills[i].colour), b = linear(fills[j].colour);
            const std::string pair = std::string(fills[i].colour) + " " + fills[j].colour;
            EXPECT_GT(std::abs(grey(a) - grey(b)), 5.0) << pair;
            for (const Matrix& eye : {everyone, protanope, deuteranope})
                EXPECT_GT(distance(oklab(a, eye), oklab(b, eye)), 0.05) << pair;
        }
}

TEST(SectionColours, NeighboursInTheListDifferWidelyInGrey) {
    for (std::size_t i = 0; i + 1 < fills.size(); ++i)
        EXPECT_GT(std::abs(grey(linear(fills[i].colour)) - grey(linear(fills[i + 1].colour))), 11.0)
            << fills[i].colour;
}

TEST(SectionColours, WritingIsLegible) {  // WCAG 2: 4.5 and more
    const auto luminance = [](const Triple& rgb) {
        return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    };
    for (const Fill& each : fills) {
        const double Y = luminance(linear(each.colour));
        const double contrast =
            each.dark ? 1.05 / (Y + 0.05) : (Y + 0.05) / (luminance(linear("#111111")) + 0.05);
        EXPECT_GE(contrast, 4.5) << each.colour;
    }
}

TEST(SectionColours, AThirteenthMaterialIsHatched) {
    EXPECT_STREQ(fill_of(12).colour, fill_of(0).colour);
    EXPECT_EQ(hatchings_of(11), 0u);
    EXPECT_EQ(hatchings_of(12), 1u);
}

}  // namespace
}  // namespace breach::drawing
