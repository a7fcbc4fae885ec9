#include "core/exchange/mesh_snapshot.hpp"

#include <gtest/gtest.h>

#include "core/fault/fault.hpp"
#include "tests/unit/exchange/samples.hpp"

namespace breach::exchange {
namespace {

using samples::Folder;

TEST(MeshSnapshot, ComesBackBitForBit) {
    const Folder folder;
    const MeshSnapshot s = samples::mesh(5);
    write_mesh_snapshot(folder / "a.vtkhdf", s, samples::provenance());
    const MeshSnapshotFile file = read_mesh_snapshot(folder / "a.vtkhdf");
    const MeshSnapshot& r = file.snapshot;
    EXPECT_EQ(r.time, s.time);
    EXPECT_EQ(r.step, s.step);
    EXPECT_EQ(r.thickness, s.thickness);
    EXPECT_EQ(r.regions, s.regions);
    EXPECT_EQ(r.materials_of_regions, s.materials_of_regions);
    EXPECT_EQ(r.position_0, s.position_0);
    EXPECT_EQ(r.displacement, s.displacement);
    EXPECT_EQ(r.velocity, s.velocity);
    EXPECT_EQ(r.acceleration, s.acceleration);
    EXPECT_EQ(r.nodal_mass, s.nodal_mass);
    EXPECT_EQ(r.pore_pressure, s.pore_pressure);
    EXPECT_EQ(r.quads, s.quads);
    EXPECT_EQ(r.region_of_element, s.region_of_element);
    EXPECT_EQ(r.density, s.density);
    EXPECT_EQ(r.gauss_per_element, s.gauss_per_element);
    EXPECT_EQ(r.gauss_positions, s.gauss_positions);
    EXPECT_EQ(r.stress, s.stress);
    EXPECT_EQ(r.strain, s.strain);
    EXPECT_EQ(r.epsilon_q, s.epsilon_q);
    EXPECT_EQ(r.epsilon_q_plastic, s.epsilon_q_plastic);
}

TEST(MeshSnapshot, CarriesItsProvenance) {
    const Folder folder;
    const Provenance p = samples::provenance();
    write_mesh_snapshot(folder / "a.vtkhdf", samples::mesh(1), p);
    const Provenance r = read_mesh_snapshot(folder / "a.vtkhdf").provenance;
    EXPECT_EQ(r.phase, p.phase);
    EXPECT_EQ(r.version, p.version);
    EXPECT_EQ(r.scene, p.scene);
    EXPECT_EQ(r.overrides, p.overrides);
    ASSERT_EQ(r.inputs.size(), 1u);
    EXPECT_EQ(r.inputs[0].path, p.inputs[0].path);
    EXPECT_EQ(r.inputs[0].sha256, p.inputs[0].sha256);
    EXPECT_EQ(r.threads, p.threads);
    EXPECT_EQ(r.spent.wall, p.spent.wall);
    EXPECT_EQ(r.spent.cpu, p.spent.cpu);
}

TEST(MeshSnapshot, WithoutWaterHasNoPorePressure) {
    const Folder folder;
    MeshSnapshot s = samples::mesh(2);
    s.pore_pressure.clear();
    write_mesh_snapshot(folder / "a.vtkhdf", s, {});
    EXPECT_TRUE(read_mesh_snapshot(folder / "a.vtkhdf").snapshot.pore_pressure.empty());
}

TEST(MeshSnapshot, CarriesTheStressBeforeTheShakingWhenThereIsOne) {
    const Folder folder;
    MeshSnapshot s = samples::mesh(2);
    write_mesh_snapshot(folder / "without.vtkhdf", s, {});
    EXPECT_TRUE(read_mesh_snapshot(folder / "without.vtkhdf").snapshot.sigma_v0.empty());
    for (std::size_t i = 0; i < s.position_0.size(); ++i) {
        s.sigma_v0.push_back(1e4 * static_cast<double>(i) + 1.0 / 3.0);
        s.pore_pressure_0.push_back(-7.0 * static_cast<double>(i));
    }
    write_mesh_snapshot(folder / "with.vtkhdf", s, {});
    const MeshSnapshot r = read_mesh_snapshot(folder / "with.vtkhdf").snapshot;
    EXPECT_EQ(r.sigma_v0, s.sigma_v0);
    EXPECT_EQ(r.pore_pressure_0, s.pore_pressure_0);
    EXPECT_TRUE(r.excess_pressure_max.empty());
    s.excess_pressure_max = s.sigma_v0;
    write_mesh_snapshot(folder / "largest.vtkhdf", s, {});
    EXPECT_EQ(read_mesh_snapshot(folder / "largest.vtkhdf").snapshot.excess_pressure_max,
              s.excess_pressure_max);
    s.r_u_max = s.epsilon_q;
    s.shear_strain_max = s.epsilon_q_plastic;
    write_mesh_snapshot(folder / "points.vtkhdf", s, {});
    const MeshSnapshot points = read_mesh_snapshot(folder / "points.vtkhdf").snapshot;
    EXPECT_EQ(points.r_u_max, s.r_u_max);
    EXPECT_EQ(points.shear_strain_max, s.shear_strain_max);
    s.excess_pressure_max.pop_back();
    EXPECT_THROW(write_mesh_snapshot(folder / "no.vtkhdf", s, {}), std::logic_error);
    s.excess_pressure_max.clear();
    s.pore_pressure_0.pop_back();
    EXPECT_THROW(write_mesh_snapshot(folder / "no.vtkhdf", s, {}), std::logic_error);
}

TEST(MeshSnapshot, TheSameStateGivesTheSameBytes) {
    const Folder folder;
    write_mesh_snapshot(folder / "a.vtkhdf", samples::mesh(50), samples::provenance());
    write_mesh_snapshot(folder / "b.vtkhdf", samples::mesh(50), samples::provenance());
    EXPECT_EQ(samples::content(folder / "a.vtkhdf"), samples::content(folder / "b.vtkhdf"));
    EXPECT_EQ(folder.entries(), 2u);
}

TEST(MeshSnapshot, ArraysOfDifferentLengthsAreNeverWritten) {
    const Folder folder;
    MeshSnapshot s = samples::mesh(2);
    s.velocity.pop_back();
    EXPECT_THROW(write_mesh_snapshot(folder / "a.vtkhdf", s, {}), std::logic_error);
    EXPECT_EQ(folder.entries(), 0u);
}

void expect_refused(const MeshSnapshot& s, const std::string& dataset, std::size_t copies = 0) {
    const Folder folder;
    write_mesh_snapshot(folder / "bad.vtkhdf", s, {});
    try {
        read_mesh_snapshot(folder / "bad.vtkhdf");
        FAIL() << "not refused: " << dataset;
    } catch (const fault::BadInput& refusal) {
        EXPECT_NE(refusal.file().find("bad.vtkhdf"), std::string::npos);
        ASSERT_EQ(refusal.faults().size(), 1u + copies) << refusal.what();
        EXPECT_EQ(refusal.faults()[0].pointer, dataset);
        EXPECT_FALSE(refusal.faults()[0].remedy.empty());
    }
}

TEST(MeshSnapshot, WhatMakesNoSenseIsRefusedByDatasetPath) {
    MeshSnapshot s = samples::mesh(3);
    s.velocity[4].y() = std::nan("");
    expect_refused(s, "/VTKHDF/PointData/velocity");

    s = samples::mesh(3);
    s.stress[7](2) = INFINITY;
    expect_refused(s, "/breachline/gauss/stress", 2);  // and two averages for ParaView

    s = samples::mesh(3);
    s.quads[2][1] = 8;  // there are nodes 0 to 7
    expect_refused(s, "/breachline/quads");

    s = samples::mesh(3);
    s.region_of_element[0] = 2;
    expect_refused(s, "/VTKHDF/CellData/region");

    s = samples::mesh(3);
    s.density[1] = 0.0;
    expect_refused(s, "/VTKHDF/CellData/density");
}

}  // namespace
}  // namespace breach::exchange
