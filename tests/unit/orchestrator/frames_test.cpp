// Data of a FEM snapshot for the dashboard: nodal values of a column, checked by hand.
#include "services/orchestrator/files/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/phases/phases.hpp"
#include "tests/folder.hpp"

namespace breach::orchestrator::frames_test {
namespace {

/// Three unit squares on top of each other, two nodes per level; water in the lower two.
exchange::MeshSnapshot column() {
    exchange::MeshSnapshot s;
    s.time = 1.5;
    s.regions = {"column"};
    s.materials_of_regions = {"sand"};
    for (int level = 0; level < 4; ++level) {
        for (int side = 0; side < 2; ++side) {
            s.position_0.emplace_back(side, level);
            s.displacement.emplace_back(0.3 * level, -0.4 * level);
            s.velocity.emplace_back(0.0, 2.0);
            s.acceleration.emplace_back(0.0, 0.0);
            s.nodal_mass.push_back(1.0);
            const double u_0 = level == 0 ? 2e4 : level == 1 ? 1e4 : 0.0;
            s.pore_pressure_0.push_back(u_0);
            s.pore_pressure.push_back(u_0 > 0.0 ? u_0 + 5e3 : 0.0);
            s.sigma_v0.push_back(1e5);
        }
    }
    const double near = 0.5 - 0.5 / std::sqrt(3.0), far = 1.0 - near;
    for (const double eta : {near, far})
        for (const double xi : {near, far})
            s.gauss_positions.emplace_back(2.0 * xi - 1.0, 2.0 * eta - 1.0);
    for (std::int32_t e = 0; e < 3; ++e) {
        s.quads.push_back({2 * e, 2 * e + 1, 2 * e + 3, 2 * e + 2});
        s.region_of_element.push_back(0);
        s.density.push_back(1800.0);
        for (int g = 0; g < 4; ++g) {
            s.stress.emplace_back(-7.0, -1e4 * (e + 1), -7.0, 3.0);
            s.strain.emplace_back(0.0, 0.0, 0.0, 0.0);
            s.epsilon_q.push_back(0.1 * e + 0.01 * g);
            s.epsilon_q_plastic.push_back(0.0);
        }
    }
    return s;
}

struct Decoded {
    nlohmann::json head;
    std::map<std::string, std::vector<float>> fields;
};

Decoded decoded(const std::string& bytes) {
    const std::size_t line = bytes.find('\n');
    Decoded found{nlohmann::json::parse(bytes.substr(0, line)), {}};
    std::size_t at = line + 1;
    for (const auto& name : found.head.at("fields")) {
        std::vector<float> values(found.head.at("count").get<std::size_t>());
        std::memcpy(values.data(), bytes.data() + at, 4 * values.size());
        at += 4 * values.size();
        found.fields[name] = values;
    }
    EXPECT_EQ(at + 16 * found.head.value("quads", 0), bytes.size());
    return found;
}

class Frames : public ::testing::Test {
  protected:
    Frames() { exchange::write_mesh_snapshot(folder_ / "snapshot_1.5.vtkhdf", column(), {}); }
    std::string points(const std::vector<std::string>& wanted = {}) {
        return reader_.points(folder_ / "snapshot_1.5.vtkhdf", phases::fem.program, 1, wanted);
    }

  private:
    test::Folder folder_;
    FrameReader reader_;
};

TEST_F(Frames, AMeshHasNodalMeansOfItsElements) {
    const Decoded found = decoded(points());
    EXPECT_EQ(found.head.at("time"), 1.5);
    EXPECT_EQ(found.head.at("quads"), 3);
    // Compression positive; the mean of the elements that touch the node.
    const float sigma_v[] = {1e4F, 1.5e4F, 2.5e4F, 3e4F},
                epsilon_q[] = {0.015F, 0.065F, 0.165F, 0.215F};
    for (std::size_t node = 0; node < 8; ++node) {
        const auto level = static_cast<float>(node / 2);
        EXPECT_FLOAT_EQ(found.fields.at("sigma_v")[node], sigma_v[node / 2]);
        EXPECT_FLOAT_EQ(found.fields.at("epsilon_q")[node], epsilon_q[node / 2]);
        EXPECT_FLOAT_EQ(found.fields.at("u_x")[node], 0.3F * level);
        EXPECT_FLOAT_EQ(found.fields.at("u_y")[node], -0.4F * level);
        EXPECT_FLOAT_EQ(found.fields.at("displacement")[node], 0.5F * level);
        EXPECT_FLOAT_EQ(found.fields.at("y")[node], 0.6F * level);
        EXPECT_FLOAT_EQ(found.fields.at("speed")[node], 2.0F);
    }
}

TEST_F(Frames, DrySoilHasNoPorePressureRatioRatherThanNone) {
    const Decoded found = decoded(points({"r_u"}));
    EXPECT_EQ(found.head.at("fields"), (nlohmann::json{"x", "y", "r_u"}));
    // Means of the elements' means: 5 kPa below, (5 + 5 + 0 + 0)/4 in the middle, nothing above.
    const std::vector<float>& r_u = found.fields.at("r_u");
    EXPECT_FLOAT_EQ(r_u[0], 0.05F);
    EXPECT_FLOAT_EQ(r_u[2], 0.0375F);
    EXPECT_FLOAT_EQ(r_u[4], 0.025F);
    EXPECT_TRUE(std::isnan(r_u[6]) && std::isnan(r_u[7]));
}

TEST_F(Frames, AFieldThatTheSnapshotLacksIsNamedWithThoseItHas) {
    try {
        points({"r_u", "r_v"});
        FAIL();
    } catch (const NoSuchField& fault) {
        EXPECT_NE(std::string(fault.what()).find("no field \"r_v\"; it has x, y, speed"),
                  std::string::npos)
            << fault.what();
    }
}

}  // namespace
}  // namespace breach::orchestrator::frames_test
