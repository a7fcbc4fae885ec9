#include "core/exchange/particle_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/fault/fault.hpp"
#include "tests/unit/exchange/samples.hpp"

namespace breach::exchange {
namespace {

using samples::Folder;

TEST(ParticleState, ComesBackBitForBit) {
    const Folder folder;
    const ParticleState s = samples::particles(9);
    write_particle_state(folder / "p.vtkhdf", s, samples::provenance());
    const ParticleStateFile file = read_particle_state(folder / "p.vtkhdf");
    const ParticleState& r = file.state;
    EXPECT_EQ(r.time, s.time);
    EXPECT_EQ(r.transfer_time, s.transfer_time);
    EXPECT_EQ(r.step, s.step);
    EXPECT_EQ(r.thickness, s.thickness);
    EXPECT_EQ(r.regions, s.regions);
    EXPECT_EQ(r.materials_of_regions, s.materials_of_regions);
    EXPECT_EQ(r.position, s.position);
    EXPECT_EQ(r.velocity, s.velocity);
    EXPECT_EQ(r.velocity_gradient, s.velocity_gradient);
    EXPECT_EQ(r.mass, s.mass);
    EXPECT_EQ(r.volume_0, s.volume_0);
    EXPECT_EQ(r.volume, s.volume);
    EXPECT_EQ(r.stress, s.stress);
    EXPECT_EQ(r.epsilon_q, s.epsilon_q);
    EXPECT_EQ(r.epsilon_q_plastic, s.epsilon_q_plastic);
    EXPECT_EQ(r.gap, s.gap);
    EXPECT_EQ(r.region, s.region);
    EXPECT_TRUE(file.ledger.empty());
}

TEST(ParticleState, CarriesWaterAndWhatItsStressIsWhenThereIsWater) {
    const Folder folder;
    ParticleState s = samples::particles(3);
    write_particle_state(folder / "dry.vtkhdf", s, {});
    const ParticleState dry = read_particle_state(folder / "dry.vtkhdf").state;
    EXPECT_TRUE(dry.pore_pressure.empty() && dry.r_u.empty() && dry.stress_of_regions.empty());
    s.regions = {"tailings", "tailings"};
    s.stress_of_regions = {StressMeasure::effective, StressMeasure::total};
    s.pore_pressure = {1e3, 2e3, -3e3};
    s.r_u = {0.1, 0.7, 1.0 / 3.0};
    write_particle_state(folder / "wet.vtkhdf", s, {});
    const ParticleState wet = read_particle_state(folder / "wet.vtkhdf").state;
    EXPECT_EQ(wet.regions, s.regions);
    EXPECT_EQ(wet.stress_of_regions, s.stress_of_regions);
    EXPECT_EQ(wet.pore_pressure, s.pore_pressure);
    EXPECT_EQ(wet.r_u, s.r_u);
}

TEST(ParticleState, CarriesTheLedgerOfItsTransfer) {
    const Folder folder;
    const Ledger ledger{{"tailings", "mass", "kg", 1e6, 1e6 + 1e-6, 1e-12},
                        {"total", "momentum x", "kg m/s", -3.0, -3.5, 0.1}};
    write_particle_state(folder / "p.vtkhdf", samples::particles(2), {}, ledger);
    const Ledger r = read_particle_state(folder / "p.vtkhdf").ledger;
    ASSERT_EQ(r.size(), 2u);
    EXPECT_EQ(r[1].region, "total");
    EXPECT_EQ(r[1].quantity, "momentum x");
    EXPECT_EQ(r[1].unit, "kg m/s");
    EXPECT_EQ(r[0].before, 1e6);
    EXPECT_EQ(r[0].after, 1e6 + 1e-6);
    EXPECT_EQ(r[0].difference, 1e-12);
}

TEST(ParticleState, CarriesTheSteadyPressureOfItsMesh) {
    const Folder folder;
    ParticleState s = samples::particles(2);
    s.stress_of_regions.assign(s.regions.size(), StressMeasure::buoyant);
    s.steady_pressure = {.position = {{0, 0}, {2, 0}, {2, 1}, {0, 1}},
                         .quads = {{0, 1, 2, 3}},
                         .value = {1e4, 2e4, 0.0, 5.0}};
    write_particle_state(folder / "p.vtkhdf", s, {});
    const ParticleState r = read_particle_state(folder / "p.vtkhdf").state;
    EXPECT_EQ(r.stress_of_regions, s.stress_of_regions);
    EXPECT_EQ(r.steady_pressure.position, s.steady_pressure.position);
    EXPECT_EQ(r.steady_pressure.quads, s.steady_pressure.quads);
    EXPECT_EQ(r.steady_pressure.value, s.steady_pressure.value);
    s.steady_pressure.quads = {{0, 1, 2, 4}};
    write_particle_state(folder / "p.vtkhdf", s, {});
    EXPECT_THROW(read_particle_state(folder / "p.vtkhdf"), fault::BadInput);
}

TEST(ParticleState, AHundredThousandPointsAreSeveralChunks) {
    const Folder folder;
    const ParticleState s = samples::particles(100000);
    write_particle_state(folder / "p.vtkhdf", s, {});
    EXPECT_EQ(read_particle_state(folder / "p.vtkhdf").state.stress, s.stress);
}

TEST(ParticleFrame, HasTheFieldsThatWereAskedForInSinglePrecision) {
    const Folder folder;
    ParticleState s = samples::particles(50);
    s.velocity[7] = {1.0 / 3.0, -1e-4 / 7.0};
    const std::string_view fields[] = {"velocity", "stress", "r_u"};
    write_particle_frame(folder / "f.vtkhdf", s, fields, samples::provenance());
    const ParticleState r = read_particle_frame(folder / "f.vtkhdf");
    EXPECT_EQ(r.time, s.time);
    EXPECT_EQ(r.transfer_time, s.transfer_time);
    EXPECT_EQ(r.regions, s.regions);
    EXPECT_EQ(r.region, s.region);
    EXPECT_EQ(r.velocity[7].x(), static_cast<double>(static_cast<float>(1.0 / 3.0)));
    for (std::size_t p = 0; p < s.size(); ++p) {
        EXPECT_LE((r.position[p] - s.position[p]).norm(), 6e-8 * s.position[p].norm());
        EXPECT_LE((r.stress[p] - s.stress[p]).norm(), 6e-8 * s.stress[p].norm());
    }
    EXPECT_TRUE(r.epsilon_q.empty() && r.mass.empty() && r.velocity_gradient.empty());
    EXPECT_TRUE(r.r_u.empty()) << "asked for, but the points have none";
}

TEST(ParticleFrame, MayHoldMorePointsThanBytes) {
    const Folder folder;
    ParticleState s = samples::particles(100000);
    for (std::size_t p = 0; p < s.size(); ++p) {
        s.position[p] = {static_cast<double>(p % 16), 1.0};
        s.velocity[p].setZero();
        s.region[p] = 0;
    }
    const std::string_view fields[] = {"velocity"};
    write_particle_frame(folder / "f.vtkhdf", s, fields, {});
    EXPECT_LT(std::filesystem::file_size(folder / "f.vtkhdf"), s.size());
    EXPECT_EQ(read_particle_frame(folder / "f.vtkhdf").position, s.position);
}

TEST(ParticleFrame, IsReadFromAWholeStateToo) {
    const Folder folder;
    const ParticleState s = samples::particles(5);
    write_particle_state(folder / "p.vtkhdf", s, {});
    EXPECT_EQ(read_particle_frame(folder / "p.vtkhdf").velocity_gradient, s.velocity_gradient);
}

TEST(ParticleFrame, IsNotAStateToComputeWith) {
    const Folder folder;
    write_particle_frame(folder / "f.vtkhdf", samples::particles(5), {}, {});
    try {
        read_particle_state(folder / "f.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_NE(refusal.faults().at(0).cause.find("particle_frame"), std::string::npos);
        EXPECT_NE(refusal.faults().at(0).remedy.find("final.vtkhdf"), std::string::npos);
    }
}

TEST(ParticleFrame, CannotHoldAFieldThatPointsDoNotHave) {
    const Folder folder;
    const std::string_view fields[] = {"colour"};
    EXPECT_THROW(write_particle_frame(folder / "f.vtkhdf", samples::particles(5), fields, {}),
                 std::logic_error);
}

TEST(ParticleState, AMeshIsNotParticles) {
    const Folder folder;
    write_mesh_snapshot(folder / "m.vtkhdf", samples::mesh(2), {});
    try {
        read_particle_state(folder / "m.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_NE(refusal.faults().at(0).cause.find("mesh_snapshot"), std::string::npos);
        EXPECT_EQ(refusal.faults().at(0).pointer, "/breachline@kind");
    }
}

TEST(ParticleState, ACopyForParaViewThatIsNotANumberIsRefusedToo) {
    const Folder folder;
    ParticleState s = samples::particles(4);
    s.position[2].x() = std::nan("");
    write_particle_state(folder / "p.vtkhdf", s, {});
    MeshSnapshot mesh = samples::mesh(3);
    mesh.stress[5][1] = std::nan("");
    write_mesh_snapshot(folder / "m.vtkhdf", mesh, {});
    try {
        read_mesh_snapshot(folder / "m.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        std::vector<std::string> pointers;
        for (const fault::Fault& each : refusal.faults()) pointers.push_back(each.pointer);
        EXPECT_NE(std::ranges::find(pointers, "/breachline/gauss/stress"), pointers.end());
        EXPECT_NE(std::ranges::find(pointers, "/VTKHDF/CellData/stress"), pointers.end());
    }
    EXPECT_THROW(read_particle_state(folder / "p.vtkhdf"), fault::BadInput);
}

TEST(ParticleState, AMassOfZeroIsRefused) {
    const Folder folder;
    ParticleState s = samples::particles(4);
    s.mass[2] = 0.0;
    s.volume[3] = -1.0;
    write_particle_state(folder / "p.vtkhdf", s, {});
    try {
        read_particle_state(folder / "p.vtkhdf");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        ASSERT_EQ(refusal.faults().size(), 2u) << "every fault is named";
        EXPECT_EQ(refusal.faults()[0].pointer, "/VTKHDF/PointData/mass");
        EXPECT_EQ(refusal.faults()[1].pointer, "/VTKHDF/PointData/volume");
    }
}

}  // namespace
}  // namespace breach::exchange
