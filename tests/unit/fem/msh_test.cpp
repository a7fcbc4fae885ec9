// gmsh's text formats 2.2 and 4.1 give the same mesh; triangles, unknown names and incomplete files
// are refused.
#include <gtest/gtest.h>

#include <fstream>

#include "fem_solver/mesh/mesh.hpp"

namespace breach::fem {
namespace {

constexpr const char* names = "$PhysicalNames\n2\n1 7 \"edge\"\n2 3 \"soil\"\n$EndPhysicalNames\n";

const std::string version_2 =
    std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n") + names +
    "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n6 2 1 0\n$EndNodes\n"
    "$Elements\n3\n1 1 2 7 1 1 2\n2 3 2 3 1 1 2 3 4\n3 3 2 3 1 2 3 6 5\n$EndElements\n";

const std::string version_4 =
    std::string("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n") + names +
    "$Entities\n1 1 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 1 7 2 1 -1\n1 0 0 0 2 1 0 1 3 1 1\n$EndEntities\n"
    "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 "
    "0\n$EndNodes\n"
    "$Elements\n2 3 1 3\n1 1 1 1\n1 1 2\n2 1 3 2\n2 1 2 3 4\n3 2 3 6 5\n$EndElements\n";

class Msh : public testing::Test {
  protected:
    Mesh read(const std::string& text) {
        const auto file = std::filesystem::temp_directory_path() /
                          ("breach_" + std::to_string(getpid()) + ".msh");
        std::ofstream(file) << text;
        scene::Region soil;
        soil.name = "soil";
        try {
            Mesh mesh = read_msh(file, {{soil}});
            std::filesystem::remove(file);
            return mesh;
        } catch (...) {
            std::filesystem::remove(file);
            throw;
        }
    }
    std::string cause(const std::string& text) {
        try {
            read(text);
        } catch (const fault::BadInput& error) {
            return error.what();
        }
        return "";
    }
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
}

TEST_F(Msh, BothFormatsGiveTheSameMesh) {
    const Mesh a = read(version_2), b = read(version_4);
    EXPECT_EQ(a.nodes, b.nodes);
    EXPECT_EQ(a.quads, b.quads);
    ASSERT_EQ(a.quads.size(), 2u);
    EXPECT_GT(quality_of(a).least_jacobian, 0.99) << "a clockwise quad must be turned";
}

TEST_F(Msh, TrianglesAreRefused) {
    EXPECT_NE(
        cause(replaced(version_2, "2 3 2 3 1 1 2 3 4", "2 2 2 3 1 1 2 3")).find("1 triangles"),
        std::string::npos);
}

TEST_F(Msh, AnUnknownNameIsRefused) {
    EXPECT_NE(cause(replaced(version_4, "soil", "clay")).find("'clay'"), std::string::npos);
}

TEST_F(Msh, ATornFileIsRefused) {
    EXPECT_NE(cause(version_4.substr(0, version_4.size() - 40)), "");
    EXPECT_NE(cause("$MeshFormat\n3.0 0 8\n"), "");
    EXPECT_NE(cause(""), "");
}

TEST_F(Msh, ADeviceIsNotReadWithoutEnd) { EXPECT_THROW(read_msh("/dev/zero", {}), fault::IoError); }

TEST_F(Msh, AQuadThatIsCrossedOrNotConvexIsRefusedByItsTag) {
    const std::string crossed_2 = replaced(version_2, "1 1 2 3 4\n", "1 1 3 2 4\n");
    const std::string crossed_4 = replaced(version_4, "2 1 2 3 4\n", "2 1 3 2 4\n");
    const std::string dart = replaced(version_2, "3 1 1 0", "3 0.2 0.2 0");
    for (const std::string& text : {crossed_2, crossed_4, dart}) {
        const std::string words = cause(text);
        EXPECT_NE(words.find("element 2 near (0."), std::string::npos) << words;
        EXPECT_NE(words.find("is folded"), std::string::npos) << words;
    }
}

TEST_F(Msh, AQuadThatNamesANodeTwiceIsRefusedByItsTag) {
    for (const std::string& text : {replaced(version_2, "2 3 6 5\n", "2 3 6 6\n"),
                                    replaced(version_4, "2 3 6 5\n", "2 3 6 6\n")}) {
        const std::string words = cause(text);
        EXPECT_NE(words.find("element 3 names node 6 twice"), std::string::npos) << words;
    }
}

TEST_F(Msh, AMissingNodeIsRefused) {
    EXPECT_NE(cause(replaced(version_2, "2 3 6 5\n", "2 3 99 5\n")).find("99"), std::string::npos);
}

}  // namespace
}  // namespace breach::fem
