// Mapped blocks, their joints, and refusals.
#include "fem_solver/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include "fem_solver/model/free_field.hpp"

namespace breach::fem {
namespace {

scene::Region block(const std::string& name, geometry::Polygon polygon,
                    std::array<std::size_t, 4> corners, std::array<int, 2> divisions) {
    scene::Region region;
    region.name = name;
    region.material = 0;
    region.polygon = std::move(polygon);
    region.corners = corners;
    region.divisions = divisions;
    return region;
}

scene::Region square(const std::string& name, double left, double bottom,
                     std::array<int, 2> divisions) {
    return block(name,
                 {{left, bottom}, {left + 1, bottom}, {left + 1, bottom + 1}, {left, bottom + 1}},
                 {0, 1, 2, 3}, divisions);
}

std::vector<fault::Fault> faults_of_join(const scene::Section& section) {
    std::vector<Mesh> parts;
    for (std::size_t i = 0; i < section.regions.size(); ++i) {
        parts.push_back(map_block({section.regions[i], i}));
    }
    try {
        join(parts, section);
    } catch (const fault::BadInput& error) {
        return error.faults();
    }
    return {};
}

TEST(Divisions, AreSharedByLengthWithAtLeastOneEach) {
    EXPECT_EQ(share_divisions({30.0, 30.0}, 60), (std::vector<int>{30, 30}));
    EXPECT_EQ(share_divisions({1.0, 3.0}, 4), (std::vector<int>{1, 3}));
    EXPECT_EQ(share_divisions({0.01, 10.0}, 4), (std::vector<int>{1, 3}));
    EXPECT_TRUE(share_divisions({1.0, 1.0, 1.0}, 2).empty());
}

TEST(Block, MapsASquareToAGrid) {
    const Mesh mesh = map_block({square("a", 0, 0, {3, 2}), 0});
    EXPECT_EQ(mesh.nodes.size(), 12u);
    EXPECT_EQ(mesh.quads.size(), 6u);
    EXPECT_NEAR((mesh.nodes[5] - Vec2(1.0 / 3.0, 0.5)).norm(), 0.0, 1e-15);
    const Quality quality = quality_of(mesh);
    EXPECT_NEAR(quality.least_jacobian, 1.0, 1e-14);
    EXPECT_NEAR(quality.largest_aspect, 1.5, 1e-14);
}

TEST(Block, APolylineVertexBecomesANode) {
    const auto region =
        block("a", {{0, 0}, {4, 0}, {4, 1}, {1, 1.5}, {0, 1}}, {0, 1, 2, 4}, {8, 2});
    const Mesh mesh = map_block({region, 0});
    double nearest = 1.0;
    for (const Vec2& x : mesh.nodes) nearest = std::min(nearest, (x - Vec2(1, 1.5)).norm());
    EXPECT_EQ(nearest, 0.0);
    EXPECT_GT(quality_of(mesh).least_jacobian, 0.3);
}

TEST(Block, FewerDivisionsThanSegmentsAreRefused) {
    const auto region =
        block("a", {{0, 0}, {4, 0}, {4, 1}, {1, 1.5}, {0, 1}}, {0, 1, 2, 4}, {1, 2});
    EXPECT_THROW(map_block({region, 0}), fault::BadInput);
}

std::vector<fault::Fault> faults_of_mesh(const scene::Region& region) {
    scene::Scene scene;
    scene.section.regions = {square("beside", -5, 0, {2, 2}), region};
    scene.fem.emplace();
    try {
        build_mesh(scene, ".");
    } catch (const fault::BadInput& error) {
        return error.faults();
    }
    return {};
}

TEST(Block, ThatFoldsOntoItselfIsRefusedWithTheElementThatDoes) {
    const geometry::Polygon dart{{0, 0}, {4, 0}, {0.8, 0.8}, {0, 4}};
    const auto faults = faults_of_mesh(block("dart", dart, {0, 1, 2, 3}, {4, 4}));
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].pointer, "/section/regions/1/mesh");
    for (const char* part : {"element 11 of region 'dart' near (2.45", "is not convex"})
        EXPECT_NE(faults[0].cause.find(part), std::string::npos) << faults[0].cause;
    EXPECT_FALSE(faults[0].remedy.empty());
    // Its corners in the order that crosses two sides: a bow tie.
    const geometry::Polygon tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    EXPECT_EQ(faults_of_mesh(block("tie", tie, {0, 1, 2, 3}, {1, 1})).size(), 1u);
    // One element with two coincident corners.
    const geometry::Polygon folded{{0, 0}, {1, 0}, {1, 0}, {0, 1}};
    EXPECT_EQ(faults_of_mesh(block("triangle", folded, {0, 1, 2, 3}, {1, 1})).size(), 1u);
    EXPECT_TRUE(faults_of_mesh(square("sound", 0, 0, {2, 2})).empty());
}

TEST(Join, SharesTheNodesOfTheCommonSide) {
    const scene::Section section{{square("a", 0, 0, {3, 2}), square("b", 1, 0, {2, 2})}};
    const Mesh mesh =
        join({map_block({section.regions[0], 0}), map_block({section.regions[1], 1})}, section);
    EXPECT_EQ(mesh.nodes.size(), 12u + 9u - 3u);
    EXPECT_EQ(mesh.region_of_element.front(), 0);
    EXPECT_EQ(mesh.region_of_element.back(), 1);
}

TEST(Join, NamesAHangingNode) {
    const auto faults =
        faults_of_join({{square("lower", 0, 0, {3, 3}), square("upper", 0, 1, {4, 3})}});
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_NE(faults[0].cause.find("hanging node"), std::string::npos);
    EXPECT_NE(faults[0].cause.find("lower"), std::string::npos);
    EXPECT_NE(faults[0].cause.find("upper"), std::string::npos);
}

TEST(Join, NamesAGap) {
    const auto faults =
        faults_of_join({{square("lower", 0, 0, {3, 3}), square("upper", 0, 1.001, {3, 3})}});
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_NE(faults[0].cause.find("gap"), std::string::npos);
}

scene::Region layer(const std::string& name, double left, double right, double bottom, double top,
                    std::array<int, 2> divisions) {
    return block(name, {{left, bottom}, {right, bottom}, {right, top}, {left, top}}, {0, 1, 2, 3},
                 divisions);
}

TEST(Join, MeshesLayersThinBesideTheirNeighboursElements) {
    const scene::Section seam{{layer("low", 0, 1, 0, 5, {1, 10}),
                               layer("seam", 0, 1, 5, 5.02, {1, 1}),
                               layer("top", 0, 1, 5.02, 10.02, {1, 10})}};
    EXPECT_TRUE(faults_of_join(seam).empty());
    const scene::Section wide{{layer("low", 0, 200, 0, 1, {4, 1}),
                               layer("high", 0, 200, 1, 2, {4, 2}),
                               layer("lens", 50, 200, 2, 2.4, {3, 2})}};
    EXPECT_TRUE(faults_of_join(wide).empty());
}

TEST(Join, DistinguishesThinLayersFromGapsAndOverlaps) {
    const auto kind = [](double bottom) {
        const auto faults = faults_of_join(
            {{layer("low", 0, 200, 0, 1, {4, 1}), layer("high", 0, 200, bottom, 2, {4, 1})}});
        return faults.empty() ? std::string("none")
                              : faults[0].cause.substr(0, faults[0].cause.find(" between"));
    };
    EXPECT_EQ(kind(1.0), "none");
    EXPECT_EQ(kind(1.3), "gap");
    EXPECT_EQ(kind(0.9), "hanging node");  // on its side
    const auto within = faults_of_join(
        {{layer("low", 0, 200, 0, 1, {4, 1}), layer("high", 10, 190, 0.9, 2, {4, 1})}});
    ASSERT_EQ(within.size(), 1u);
    EXPECT_EQ(within[0].cause.substr(0, 7), "overlap");
    // Side by side, with one element each: only corners face each other.
    const auto beside = faults_of_join(
        {{layer("left", 0, 10, 0, 1, {1, 1}), layer("right", 10.01, 20, 0, 1, {1, 1})}});
    ASSERT_EQ(beside.size(), 1u);
    EXPECT_EQ(beside[0].cause.substr(0, 3), "gap");
}

TEST(Join, KeepsRegionsThatDoNotTouch) {
    EXPECT_TRUE(faults_of_join({{square("a", 0, 0, {3, 3}), square("b", 5, 0, {4, 2})}}).empty());
}

/// Two elements on top of each other, with an inclined left side.
TEST(FreeField, ASideThatLeansIsRefusedWithARemedy) {
    using scene::FreeFieldSides;
    const Mesh leaning{.nodes = {{0, 0}, {4, 0}, {0.5, 1}, {4, 1}, {1, 2}, {4, 2}},
                       .quads = {{0, 1, 3, 2}, {2, 3, 5, 4}},
                       .region_of_element = {0, 0}};
    for (const FreeFieldSides sides : {FreeFieldSides::left, FreeFieldSides::both}) {
        Mesh mesh = leaning;
        try {
            add_free_field({1.0, 1e4, sides}, mesh);
            ADD_FAILURE() << "a column was built";
        } catch (const fault::BadInput& error) {
            EXPECT_EQ(error.faults().at(0).pointer, "/fem/free_field");
            EXPECT_NE(error.faults().at(0).cause.find("left side"), std::string::npos);
            EXPECT_NE(error.faults().at(0).remedy.find("vertical side"), std::string::npos);
        }
    }
    Mesh mesh = leaning;
    EXPECT_EQ(add_free_field({1.0, 1e4, FreeFieldSides::right}, mesh).inner.size(), 3U);
}

}  // namespace
}  // namespace breach::fem
