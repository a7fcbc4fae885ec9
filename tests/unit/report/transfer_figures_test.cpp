#include "services/report/figures/transfer_figures.hpp"

#include <gtest/gtest.h>

#include "tests/unit/exchange/samples.hpp"

namespace breach::report {
namespace {

/// Four unit squares, water in all, the left half liquefied; one point in each square.
exchange::MeshSnapshot mesh() {
    auto s = exchange::samples::mesh(4);
    s.displacement.assign(s.displacement.size(), {0.0, 0.0});
    s.pore_pressure_0.assign(s.position_0.size(), 1e3);
    s.sigma_v0.assign(s.position_0.size(), 60e3);
    for (std::size_t i = 0; i < s.position_0.size(); ++i)
        s.pore_pressure[i] = s.position_0[i].x() < 2.5 ? 55e3 : 1e3;
    return s;
}

exchange::ParticleState points() {
    auto s = exchange::samples::particles(4);
    s.regions = {"tailings", "tailings"};
    s.materials_of_regions = {"sound", "liquefied_2"};
    s.stress_of_regions = {exchange::StressMeasure::effective, exchange::StressMeasure::total};
    s.stress.assign(4, {0.0, -50e3, 0.0, 0.0});
    s.pore_pressure.assign(4, 20e3);
    s.r_u = {0.9, 0.9, 0.0, 0.0};
    s.region = {1, 1, 0, 0};
    return s;
}

const LayerColours layers{0.7, false, {50e3, 100e3}, {"liquefied_1", "liquefied_2"}};

TEST(TransferFigures, BothSidesShowTheSameQuantityWithTheSameColours) {
    const auto pairs = compare(mesh(), points(), layers);
    ASSERT_EQ(pairs.size(), 3u);
    for (const BeforeAndAfter& pair : pairs) {
        EXPECT_EQ(pair.before.chart.field->label, pair.after.chart.field->label);
        EXPECT_EQ(pair.before.chart.field->range.high, pair.after.chart.field->range.high);
    }
    // 50 kPa effective, or 50 kPa total with 20 kPa of water in it.
    EXPECT_EQ(pairs[0].after.chart.field->value, (std::vector<double>{30.0, 30.0, 50.0, 50.0}));
    EXPECT_EQ(pairs[1].after.chart.field->value, points().r_u);
    EXPECT_NEAR(pairs[1].before.chart.field->value[0], 0.9, 1e-12);
    // sigma'_v0 = 60 kPa is in the second layer.
    EXPECT_EQ(pairs[2].before.chart.field->value, (std::vector<double>{2.0, 2.0, 0.0, 0.0}));
    EXPECT_EQ(pairs[2].after.chart.field->value, (std::vector<double>{2.0, 2.0, 0.0, 0.0}));
}

TEST(TransferFigures, WithoutWaterOnlyTheStressIsDrawn) {
    auto dry = mesh();
    dry.pore_pressure.clear();
    dry.pore_pressure_0.clear();
    dry.sigma_v0.clear();
    EXPECT_EQ(compare(dry, exchange::samples::particles(4), {}).size(), 1u);
}

TEST(TransferFigures, OnePageHoldsAllOfThem) {
    const std::string page = side_by_side(compare(mesh(), points(), layers));
    std::size_t charts = 0;
    for (std::size_t at = 0; (at = page.find("<svg", at)) != std::string::npos; ++at) ++charts;
    EXPECT_EQ(charts, 7u) << "six and the page around them";
}

TEST(TransferFigures, ASnapshotThatIsGoneIsNamed) {
    const exchange::samples::Folder folder;
    auto provenance = exchange::samples::provenance();
    provenance.inputs = {{"/gone/snapshot_1.vtkhdf", std::string(64, 'a')}};
    exchange::write_particle_state(folder / "particles.vtkhdf", points(), provenance);
    exchange::samples::overwrite(folder / "scene.completed.json", R"({"transfer": {}})");
    try {
        write_transfer_figures(folder.path(), folder / "figures");
        FAIL();
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("/gone/snapshot_1.vtkhdf"), std::string::npos);
    }
}

}  // namespace
}  // namespace breach::report
