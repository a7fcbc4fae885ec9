// Reading DXF of several versions, and invalid files.
#include "services/import/dxf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drawings.hpp"
#include "services/import/csv.hpp"
#include "services/import/dxf_records.hpp"

namespace breach::importing::dxf_test {
namespace {

using test::dxf;
using test::group;
using test::hatch;
using test::light;
using test::Line;
using test::path;
using test::place;

Drawing read(const std::string& text, const DxfOptions& request = {},
             const std::vector<std::string>& map = {}) {
    std::vector<Fault> faults;
    const LayerMap layers(map, {"clay", "rock"}, faults);
    EXPECT_EQ(test::told(faults), "");
    return read_dxf(text, layers, request);
}

const Line square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST(Dxf, PolylinesOfR12AndOf2000AndLinesAreRead) {
    const Drawing drawing = read(
        dxf(test::heavy("CLAY", square) + light("clay", square) + test::sides("Rock", square)));
    EXPECT_EQ(test::told(drawing.faults), "");
    ASSERT_EQ(drawing.outlines.size(), 6u);
    EXPECT_EQ(drawing.outlines[0].points, square);
    EXPECT_TRUE(drawing.outlines[0].closed);
    EXPECT_EQ(drawing.outlines[1].points, square);
    EXPECT_EQ(named(drawing.outlines[1]), "LWPOLYLINE 2F on layer clay");
    EXPECT_EQ(drawing.outlines[2].points, (Line{{0, 0}, {4, 0}}));
}

TEST(Dxf, AnOutlineKnowsItsLineAlsoWithWindowsLineEnds) {
    std::string text = dxf(light("CLAY", square));
    const std::size_t line =
        static_cast<std::size_t>(
            std::count(text.begin(),
                       text.begin() + static_cast<std::ptrdiff_t>(text.find("LWPOLYLINE")), '\n')) +
        1;
    EXPECT_EQ(read(text).outlines.at(0).origin.line, line);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, "\r");
    EXPECT_EQ(read(text).outlines.at(0).origin.line, line);
    EXPECT_EQ(read(text).outlines.at(0).points, square);
}

TEST(Dxf, UnitsAreConvertedOrAskedFor) {
    const auto width = [](const Drawing& drawing) { return drawing.outlines.at(0).points[1].x(); };
    EXPECT_DOUBLE_EQ(width(read(dxf(light("CLAY", square), 4))), 4e-3);
    EXPECT_DOUBLE_EQ(width(read(dxf(light("CLAY", square), 2))), 4 * 0.3048);
    const Drawing told = read(dxf(light("CLAY", square), 4), {.unit = unit_named("cm")});
    EXPECT_DOUBLE_EQ(width(told), 0.04);
    EXPECT_EQ(told.remarks.size(), 1u);
    const Drawing unitless = read(dxf(light("CLAY", square), std::nullopt, "AC1009"));
    ASSERT_EQ(unitless.faults.size(), 1u);
    EXPECT_NE(unitless.faults[0].cause.find("does not say its unit"), std::string::npos);
}

TEST(Dxf, ArcsAreRefusedWithoutATolerance) {
    const std::string circle =
        group(0, "CIRCLE") + group(8, "CLAY") + group(10, 5.0) + group(20, 3.0) + group(40, 2.0);
    const std::string bulged = light("CLAY", {{0, 0}, {4, 0}}, true, {{0, 1.0}, {1, 1.0}});
    const Drawing refused = read(dxf(circle + bulged));
    ASSERT_EQ(refused.faults.size(), 2u);
    EXPECT_NE(refused.faults[0].cause.find("has an arc at (7, 3)"), std::string::npos);
    const Drawing flat = read(dxf(circle + bulged), {.flatten = 0.001});
    EXPECT_EQ(test::told(flat.faults), "");
    ASSERT_EQ(flat.outlines.size(), 2u);
    for (const Outline& each : flat.outlines) {
        // Chords are inside: the area is less than the circle's by at most its length times the
        // sagitta.
        const double area = geometry::signed_area(each.points), whole = 4.0 * std::numbers::pi;
        EXPECT_LT(area, whole);
        EXPECT_GT(area, whole - 4.0 * std::numbers::pi * 0.001);
    }
    const std::string arc = group(0, "ARC") + group(8, "CLAY") + group(10, 0.0) + group(20, 0.0) +
                            group(40, 2.0) + group(50, 270.0) + group(51, 90.0);
    const Outline half = read(dxf(arc), {.flatten = 0.01}).outlines.at(0);
    EXPECT_NEAR((half.points.front() - Vec2(0, -2)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((half.points.back() - Vec2(0, 2)).norm(), 0.0, 1e-12);
    for (const Vec2& each : half.points) EXPECT_NEAR(each.norm(), 2.0, 1e-12);
}

TEST(Dxf, APolylineSeenFromBehindIsMirrored) {
    const Drawing drawing = read(
        dxf(light("CLAY", square, true, {}, group(210, 0.0) + group(220, 0.0) + group(230, -1.0))));
    EXPECT_EQ(drawing.outlines.at(0).points[1], Vec2(-4, 0));
}

TEST(Dxf, WhatIsNoPolylineIsRefusedAtItsPlaceAndWritingIsPassedOver) {
    const std::string spline =
        group(0, "SPLINE") + group(5, "4A") + group(8, "CLAY") + group(10, 3.0) + group(20, 7.0);
    const std::string text = group(0, "TEXT") + group(8, "CLAY") + group(10, 3.0) + group(20, 7.0);
    const std::string block = group(0, "INSERT") + group(8, "CLAY") + group(2, "DAM");
    const std::string tilted = group(0, "LINE") + group(8, "CLAY") + group(10, 0.0) +
                               group(20, 0.0) + group(30, 0.0) + group(11, 1.0) + group(21, 0.0) +
                               group(31, 5.0);
    const Drawing drawing = read(dxf(spline + text + block + tilted));
    ASSERT_EQ(drawing.faults.size(), 3u) << test::told(drawing.faults);
    EXPECT_NE(drawing.faults[0].cause.find("SPLINE 4A on layer CLAY at (3, 7)"), std::string::npos);
    EXPECT_NE(drawing.faults[1].remedy.find("explode"), std::string::npos);
    EXPECT_NE(drawing.faults[2].cause.find("plane of the drawing"), std::string::npos);
    EXPECT_EQ(drawing.remarks, (std::vector<std::string>{"passed over: 1 TEXT"}));
}

std::string line_edge(const Vec2& from, const Vec2& to) {
    return group(72, "1") + place(10, from) + place(11, to);
}

std::string edges(const std::vector<std::string>& all) {
    std::string text = group(92, "1") + group(93, std::to_string(all.size()));
    for (const std::string& each : all) text += each;
    return text + group(97, "0");
}

TEST(Dxf, BoundariesOfHatchesAreRead) {
    // The second edge is drawn the other way round; the second path is another area.
    const std::string lines = edges({line_edge({0, 0}, {4, 0}), line_edge({4, 4}, {4, 0}),
                                     line_edge({4, 4}, {0, 4}), line_edge({0, 4}, {0, 0})});
    const Drawing drawing = read(dxf(hatch("CLAY", {path(square), lines})));
    EXPECT_EQ(test::told(drawing.faults), "");
    ASSERT_EQ(drawing.outlines.size(), 2u);
    for (const Outline& each : drawing.outlines) {
        EXPECT_EQ(each.points, square);
        EXPECT_TRUE(each.closed && each.fills);
    }
    EXPECT_EQ(read(dxf(hatch("CLAY", {path(square)}), 4)).outlines.at(0).points[1], Vec2(4e-3, 0));
}

TEST(Dxf, ArcsOfHatchesFollowTheRulesOfOtherArcs) {
    // A half disc of radius 2: by a bulge, by an arc that runs on, and by one that runs back.
    const auto arc = [](double from, double to, const char* direction) {
        return group(72, "2") + place(10, {0, 0}) + group(40, 2.0) + group(50, from) +
               group(51, to) + group(73, direction);
    };
    const std::string chord = line_edge({0, 2}, {0, -2});
    const std::vector<std::string> discs{
        path({{0, -2}, {0, 2}}, {{0, 1.0}}), edges({chord, arc(270, 450, "1")}),
        edges({chord, arc(-90, 90, "1")}), edges({arc(-90, 90, "0"), chord})};
    for (const std::string& each : discs) {
        const Drawing flat = read(dxf(hatch("CLAY", {each})), {.flatten = 1e-4});
        EXPECT_EQ(test::told(flat.faults), "");
        EXPECT_NEAR(std::abs(geometry::signed_area(flat.outlines.at(0).points)),
                    2.0 * std::numbers::pi, 1e-3);
        double farthest = 0.0;
        for (const Vec2& corner : flat.outlines[0].points)
            farthest = std::max(farthest, corner.x());
        EXPECT_NEAR(farthest, 2.0, 1e-3);
        const Drawing refused = read(dxf(hatch("CLAY", {each})));
        ASSERT_EQ(refused.faults.size(), 1u);
        EXPECT_NE(refused.faults[0].cause.find("HATCH 7B on layer CLAY has an arc at"),
                  std::string::npos)
            << refused.faults[0].cause;
    }
}

TEST(Dxf, SolidsTracesAndFacesAreAreas) {
    const auto corners = [](const char* type, const Line& line) {
        std::string text = group(0, type) + group(8, "CLAY");
        for (int i = 0; i < 4; ++i) text += place(10 + i, line[i]) + group(30 + i, 0.0);
        return text;
    };
    const Line crossed{{0, 0}, {4, 0}, {0, 4}, {4, 4}}, triangle{{0, 0}, {4, 0}, {4, 4}, {4, 4}};
    const Drawing drawing = read(dxf(corners("SOLID", crossed) + corners("TRACE", crossed) +
                                     corners("3DFACE", square) + corners("SOLID", triangle)));
    EXPECT_EQ(test::told(drawing.faults), "");
    ASSERT_EQ(drawing.outlines.size(), 4u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(drawing.outlines[i].points, square);
    EXPECT_EQ(drawing.outlines[3].points, (Line{{0, 0}, {4, 0}, {4, 4}}));
}

TEST(Dxf, NoLayerWithAMeaningIsLeftOutInSilence) {
    const auto at = [](const char* type, const std::string& layer) {
        return group(0, type) + group(8, layer) + place(10, {3, 7});
    };
    const std::string ellipse = edges({group(72, "3") + place(10, {3, 7}) + place(11, {1, 0})});
    const std::string open = edges({line_edge({3, 7}, {4, 0}), line_edge({4, 0}, {4, 4})});
    for (const char* type : {"SPLINE", "REGION", "MLINE", "BODY", "INSERT", "LEADER", "POINT",
                             "ACAD_PROXY_ENTITY", "3DSOLID", "ELLIPSE"}) {
        for (const std::string layer : {"CLAY", "PHREATIC", "ground"}) {
            const Drawing drawing = read(dxf(at(type, layer) + light("ROCK", square)));
            ASSERT_EQ(drawing.faults.size(), 1u) << type;
            const std::string& cause = drawing.faults[0].cause;
            EXPECT_NE(cause.find("layer " + layer), std::string::npos) << cause;
            EXPECT_NE(cause.find("at (3, 7)"), std::string::npos) << cause;
            EXPECT_NE(cause.find(type), std::string::npos) << cause;
        }
    }
    for (const std::string& each : {ellipse, open, edges({line_edge({3, 7}, {3, 7})})}) {
        const Drawing drawing = read(dxf(hatch("CLAY", {each})));
        ASSERT_EQ(drawing.faults.size(), 1u);
        EXPECT_TRUE(drawing.faults[0].cause.starts_with("HATCH 7B on layer CLAY at ("))
            << drawing.faults[0].cause;
    }
    // A hatch of water is no line; beside the line it is passed over.
    EXPECT_EQ(read(dxf(hatch("PHREATIC", {path(square)}))).faults.size(), 1u);
    const Drawing water =
        read(dxf(hatch("PHREATIC", {path(square)}) + light("PHREATIC", {{0, 1}, {4, 1}}, false)));
    EXPECT_EQ(test::told(water.faults), "");
    EXPECT_EQ(water.remarks, (std::vector<std::string>{"passed over: 1 HATCH"}));
    EXPECT_EQ(test::told(read(dxf(hatch("CLAY", {path(square)})), {}, {"CLAY=none"}).faults), "");
}

TEST(Dxf, ALayerOfTextIsLeftOutUnlessItIsNamedLikeTheWater) {
    const auto text = [](const char* type, const std::string& layer) {
        return group(0, type) + group(8, layer) + place(10, {3, 7});
    };
    const std::string rock = light("ROCK", square);
    for (const char* type : {"TEXT", "MTEXT"}) {
        const Drawing drawing = read(dxf(text(type, "CLAY") + text(type, "ground") + rock));
        EXPECT_EQ(test::told(drawing.faults), "");
        EXPECT_EQ(drawing.remarks[0], "layer CLAY has only text: it was left out");
        EXPECT_EQ(read(dxf(text(type, "PHREATIC") + rock)).faults.size(), 1u);
        const std::string mapped = dxf(text(type, "labels") + rock);
        EXPECT_EQ(read(mapped, {}, {"labels=clay"}).faults.size(), 1u) << "the user wants soil";
        EXPECT_TRUE(read(mapped, {}, {"labels=none"}).layers.contains("labels"))
            << "it can be mapped to none";
    }
}

TEST(Dxf, LayersWithoutMeaningAreReportedOnceAndFrozenOnesAreLeftOut) {
    const std::string tables = group(0, "SECTION") + group(2, "TABLES") + group(0, "LAYER") +
                               group(2, "OLD") + group(70, "1") + group(62, "7") +
                               group(0, "ENDSEC");
    const Drawing drawing =
        read(dxf(light("GRAVEL", square) + light("GRAVEL", square) + light("OLD", square), 6,
                 "AC1015", tables));
    ASSERT_EQ(drawing.unknown.size(), 1u);
    EXPECT_EQ(drawing.unknown.at("GRAVEL").entities, 2u);
    ASSERT_EQ(drawing.remarks.size(), 1u);
    EXPECT_NE(drawing.remarks[0].find("layer OLD is frozen or off"), std::string::npos);
    EXPECT_EQ(
        read(dxf(light("OLD", square), 6, "AC1015", tables), {}, {"OLD=rock"}).outlines.size(), 1u);
}

TEST(Dxf, FilesThatAreNoneAreRefusedWithTheReason) {
    EXPECT_NE(
        form_faults(std::string("AutoCAD Binary DXF\r\n\x1a\0", 22)).at(0).cause.find("binary"),
        std::string::npos);
    EXPECT_NE(form_faults("AC1032rest").at(0).cause.find("DWG"), std::string::npos);
    EXPECT_EQ(form_faults(std::string("0\nSEC\0TION", 10)).at(0).pointer, "byte 5");
    EXPECT_EQ(form_faults(" \n\n").size(), 1u);
    const std::string whole = dxf(light("CLAY", square));
    for (std::size_t length = 1; length < whole.size() - 4; ++length) {
        const Drawing cut = read(whole.substr(0, length));
        EXPECT_FALSE(cut.faults.empty()) << length;
    }
    std::string nan = whole;
    nan.replace(nan.find("\n10\n0\n"), 6, "\n10\nnan\n");
    const Drawing drawing = read(nan);
    ASSERT_EQ(drawing.faults.size(), 1u);
    EXPECT_NE(drawing.faults[0].cause.find("\"nan\" is no number"), std::string::npos);
}

TEST(Dxf, AMillionEntitiesArePassedOverAndTooManyOfTheSectionAreRefusedOnce) {
    std::string many;
    const std::string point = group(0, "POINT") + group(8, "0");
    for (int i = 0; i < 1'000'000; ++i) many += point;
    const Drawing passed = read(dxf(many));
    EXPECT_EQ(test::told(passed.faults), "");
    EXPECT_EQ(passed.remarks, (std::vector<std::string>{"passed over: 1000000 POINT"}));
    std::string lines;
    for (int i = 0; i < 20'000; ++i) lines += test::sides("CLAY", {{0, 0}, {1, 1}});
    const Drawing refused = read(dxf(lines));
    ASSERT_EQ(refused.faults.size(), 1u);
    EXPECT_NE(refused.faults[0].cause.find("more than 2000 outlines"), std::string::npos);
}

TEST(Csv, RegionsAreReadWithTheirUnitsAndSeparators) {
    std::vector<Fault> faults;
    const LayerMap layers({}, {"clay"}, faults);
    const Drawing plain = read_csv(
        "# a dam\nregion,x,y\nclay,0,0\nclay,4,0\nclay,4,4\nclay,0,0\n\n"
        "clay,5,0\nclay,6,0\nclay,6,1\nPHREATIC,0,3\nPHREATIC,9,2\n",
        layers, Unit{"m", 1.0});
    EXPECT_EQ(test::told(plain.faults), "");
    ASSERT_EQ(plain.outlines.size(), 3u);
    EXPECT_EQ(plain.outlines[0].points, (Line{{0, 0}, {4, 0}, {4, 4}}));
    EXPECT_EQ(plain.outlines[0].origin.line, 3u);
    EXPECT_FALSE(plain.outlines[2].closed);
    const Drawing decimal =
        read_csv("y;x;region\r\n0,5;1,5;clay\r\n1;2;clay\r\n", layers, Unit{"ft", 0.3048});
    ASSERT_EQ(decimal.outlines.size(), 1u);
    EXPECT_EQ(decimal.outlines[0].points[0], Vec2(1.5 * 0.3048, 0.5 * 0.3048));
}

TEST(Csv, EveryBadRowIsReportedByItsLine) {
    std::vector<Fault> faults;
    const LayerMap layers({}, {"clay"}, faults);
    const Drawing drawing = read_csv(
        "region,x,y\nclay,0,0\nclay,nan,1\nclay,1\nclay,1e99,2\n,3,4\n", layers, Unit{"m", 1.0});
    ASSERT_EQ(drawing.faults.size(), 4u) << test::told(drawing.faults);
    EXPECT_EQ(drawing.faults[0].pointer, "line 3");
    EXPECT_EQ(drawing.faults[3].pointer, "line 6");
    EXPECT_EQ(read_csv("a,b\n1,2\n", layers, Unit{"m", 1.0}).faults.size(), 1u);
    EXPECT_EQ(read_csv("", layers, Unit{"m", 1.0}).faults.size(), 1u);
}

TEST(Csv, AHeaderWithTwoColumnsOfOneMeaningIsRefused) {
    std::vector<Fault> faults;
    const LayerMap layers({"phreatic=phreatic"}, {"clay"}, faults);
    const auto of = [&](const std::string& text, const std::string& alone = "") {
        return read_csv(text, layers, Unit{"m", 1.0}, alone);
    };
    const Drawing levels = of("x,y,z\n0,9,0\n5,8,0\n", "phreatic");
    ASSERT_EQ(levels.faults.size(), 1u) << test::told(levels.faults);
    EXPECT_EQ(levels.faults[0].pointer, "line 1");
    EXPECT_NE(levels.faults[0].cause.find("2 columns of levels: y and z"), std::string::npos);
    EXPECT_NE(levels.faults[0].remedy.find("call it y"), std::string::npos);
    EXPECT_TRUE(levels.outlines.empty());
    for (const char* header :
         {"region,x,y,z", "region,x,y,Y", "region,x,X,y", "region,layer,x,y"}) {
        const Drawing refused = of(std::string(header) + "\nclay,1,2,3\n");
        EXPECT_EQ(refused.faults.size(), 1u) << header << "\n" << test::told(refused.faults);
    }
    for (const char* header : {"region,x,y", "layer,x,z", "region,x,z,note,note"}) {
        const Drawing taken = of(std::string(header) + "\nclay,1,2\nclay,2,2\nclay,2,3\n");
        EXPECT_EQ(test::told(taken.faults), "") << header;
        EXPECT_EQ(taken.outlines.at(0).points, (Line{{1, 2}, {2, 2}, {2, 3}})) << header;
    }
}

TEST(Csv, DecimalCommasBetweenCommasAreRefused) {
    std::vector<Fault> faults;
    const LayerMap layers({}, {"clay"}, faults);
    const Drawing drawing = read_csv(
        "region,x,y\nclay,20,5,20,0\nclay,4,0,\nclay,4,4\nclay,0,4,,\n", layers, Unit{"m", 1.0});
    ASSERT_EQ(drawing.faults.size(), 1u) << test::told(drawing.faults);
    EXPECT_EQ(drawing.faults[0].pointer, "line 2");
    EXPECT_NE(drawing.faults[0].cause.find("has 5 fields, and the header names 3"),
              std::string::npos);
    EXPECT_NE(drawing.faults[0].remedy.find("decimal commas"), std::string::npos);
    EXPECT_NE(drawing.faults[0].remedy.find("; or tabs"), std::string::npos);
    EXPECT_EQ(drawing.outlines.at(0).points.size(), 3u);
}

}  // namespace
}  // namespace breach::importing::dxf_test
