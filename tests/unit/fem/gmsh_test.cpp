// Unstructured regions with gmsh. Skipped if gmsh is not installed.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>

#include "fem_solver/mesh/mesh.hpp"
#include "tests/folder.hpp"

namespace breach::fem {
namespace {

class Gmsh : public testing::Test {
  protected:
    const test::Folder scratch_;
    const std::filesystem::path& folder_ = scratch_.path();
};

/// A dam of unstructured quads on a block of foundation.
scene::Section dam() {
    scene::Region foundation, embankment;
    foundation.name = "foundation";
    foundation.polygon = {{-10, -4}, {20, -4}, {20, 0}, {10, 0}, {0, 0}, {-10, 0}};
    foundation.corners = {0, 1, 2, 5};
    foundation.divisions = {30, 4};
    embankment.name = "embankment";
    embankment.polygon = {{0, 0}, {10, 0}, {6, 4}, {4.5, 4}};
    embankment.mesh = scene::RegionMesh::unstructured;
    embankment.element_size = 0.8;
    return {{foundation, embankment}};
}

bool is_installed() { return std::system("gmsh --version >/dev/null 2>&1") == 0; }

TEST_F(Gmsh, MeshesADamOnABlockConformingly) {
    if (!is_installed()) GTEST_SKIP() << "gmsh is not installed";
    const scene::Section section = dam();
    const Mesh mesh = mesh_with_gmsh(section, folder_);
    double area = 0.0;
    std::size_t in_block = 0;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = corners_of(mesh, e);
        const Vec2 d1 = x.col(2) - x.col(0), d2 = x.col(3) - x.col(1);
        area += 0.5 * (d1.x() * d2.y() - d1.y() * d2.x());
        in_block += mesh.region_of_element[e] == 0 ? 1 : 0;
    }
    EXPECT_NEAR(area, 120.0 + 0.5 * (10.0 + 1.5) * 4.0, 1e-9)
        << "the mesh covers both regions once";
    EXPECT_EQ(in_block, 120u) << "the block stays structured";
    EXPECT_GT(mesh.quads.size(), 140u);
    EXPECT_EQ(join({mesh}, section).nodes.size(), mesh.nodes.size())
        << "no doubled nodes, no hanging ones";
    EXPECT_GT(quality_of(mesh).least_jacobian, 0.2);
}

TEST_F(Gmsh, GivesTheSameMeshEachTime) {
    if (!is_installed()) GTEST_SKIP() << "gmsh is not installed";
    const Mesh a = mesh_with_gmsh(dam(), folder_), b = mesh_with_gmsh(dam(), folder_);
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.quads, b.quads);
}

TEST_F(Gmsh, IsNamedWhenItIsMissing) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder_.c_str(), 1);
    try {
        mesh_with_gmsh(dam(), folder_);
        ADD_FAILURE() << "gmsh was found on an empty PATH";
    } catch (const fault::IoError& error) {
        EXPECT_NE(std::string(error.what()).find("install"), std::string::npos) << error.what();
    }
    setenv("PATH", path.c_str(), 1);
}

/// A gmsh that never ends; the test would not end either if the program waited for it.
TEST_F(Gmsh, IsEndedWhenTheRunIsStopped) {
    const auto fake = folder_ / "gmsh";
    std::ofstream(fake) << "#!/bin/sh\necho $$ > '" << (folder_ / "pid").string()
                        << "'\nexec sleep 100000\n";
    std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
    const auto stop = [&] {
        std::ifstream pid(folder_ / "pid");
        return pid.peek() != std::ifstream::traits_type::eof();
    };
    EXPECT_THROW(mesh_with_gmsh(dam(), folder_, stop), MeshingStopped);
    setenv("PATH", path.c_str(), 1);
    pid_t child = 0;
    std::ifstream(folder_ / "pid") >> child;
    EXPECT_EQ(kill(child, 0), -1) << "gmsh still runs";
}

TEST_F(Gmsh, AnOddBorderGetsOneMoreEdgeOnItsOwnSide) {
    scene::Section section = dam();
    section.regions[0].divisions = {32, 4};  // 11 + 11 + 10 on top: the dam's base has 11
    if (!is_installed()) GTEST_SKIP() << "gmsh is not installed";
    EXPECT_NO_THROW(mesh_with_gmsh(section, folder_)) << "its own side takes one more";
}

}  // namespace
}  // namespace breach::fem
