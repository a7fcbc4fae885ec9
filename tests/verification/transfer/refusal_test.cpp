// Refusals of a transfer, and their messages.
#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer::refusal_test {
namespace {

scene::Scene scene_of(const exchange::MeshSnapshot& mesh) {
    return meshes::scene_for(mesh, meshes::elastic, meshes::settings(2));
}

std::string refusal_of(const exchange::MeshSnapshot& mesh) {
    try {
        transfer(mesh, scene_of(mesh), {}, "snapshot_3.5.vtkhdf");
    } catch (const fault::Breakdown& refusal) {
        return refusal.what();
    }
    return "";
}

// The grid has 6 x 5 elements; node 16 = (i 2, j 2) is the upper right corner of element 7.
TEST(EntangledMesh, IsRefusedByElementTimeAndJacobian) {
    auto mesh = meshes::grid({});
    mesh.displacement[16] = {-2.5, -2.5};  // beyond the opposite corner: element 7 turns inside out
    const std::string text = refusal_of(mesh);
    EXPECT_NE(text.find("snapshot_3.5.vtkhdf"), std::string::npos) << text;
    EXPECT_NE(text.find("t = 3.5"), std::string::npos) << text;
    EXPECT_NE(text.find("element 7 "), std::string::npos) << text;
    EXPECT_NE(text.find("|J_t|/|J_0|"), std::string::npos) << text;
}

// The area at the centre is still positive, one corner is inside the diagonal: only the corner
// shows it.
TEST(EntangledMesh, ACornerInsideTheDiagonalIsRefused) {
    auto mesh = meshes::grid({});
    mesh.displacement[16] = {-1.2, -1.2};
    EXPECT_NE(refusal_of(mesh).find("worst corner"), std::string::npos);
}

TEST(EntangledMesh, ManyElementsAreCountedNotListed) {
    auto mesh = meshes::grid({});
    for (std::size_t i = 0; i < mesh.displacement.size(); ++i)
        mesh.displacement[i].x() = -2.0 * mesh.position_0[i].x();  // mirrored
    EXPECT_NE(refusal_of(mesh).find("and 25 more"), std::string::npos) << refusal_of(mesh);
}

TEST(EntangledMesh, AMeshThatWasNeverRightIsBadInput) {
    auto mesh = meshes::grid({});
    std::swap(mesh.quads[3][1], mesh.quads[3][3]);
    EXPECT_THROW(transfer(mesh, scene_of(mesh), {}, "snapshot"), fault::BadInput);
}

}  // namespace
}  // namespace breach::transfer::refusal_test
