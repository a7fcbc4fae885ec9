#include "transfer_tool/ledger.hpp"

#include <gtest/gtest.h>

#include "tests/verification/transfer/meshes.hpp"

namespace breach::transfer {
namespace {

TEST(Ledger, NamesTheRegionAndQuantityThatIsLost) {
    const exchange::Ledger ledger{{"dam", "mass", "kg", 1.0, 1.1, 0.1},
                                  {"dam", "momentum x", "kg m/s", 1.0, 1.0, 1e-11},
                                  {"dam", "elastic energy", "J", 1.0, 2.0, 1.0}};
    try {
        refuse_losses(ledger, meshes::settings());
        FAIL();
    } catch (const fault::Breakdown& refusal) {
        const std::string text = refusal.what();
        EXPECT_NE(text.find("mass of region \"dam\""), std::string::npos) << text;
        EXPECT_EQ(text.find("momentum x of"), std::string::npos) << "within what is allowed";
        EXPECT_EQ(text.find("elastic energy of"), std::string::npos) << "reported, not limited";
    }
}

TEST(Ledger, PrintsOneAlignedLinePerRow) {
    const std::string text = as_text({{"dam", "mass", "kg", 1.0, 1.0, 0.0},
                                      {"a longer name", "momentum x", "kg m/s", 1.0, 1.0, 0.0}});
    std::size_t lines = 0;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        EXPECT_EQ(end - begin, text.find('\n'));
        ++lines;
    }
    EXPECT_EQ(lines, 3u);
}

TEST(Ledger, RefusesGaussPointsOfNoKnownRule) {
    auto mesh = meshes::grid({});
    mesh.gauss_positions[0].x() *= 0.9;
    const Points points = meshes::points_on(mesh, 2);
    const auto scene = meshes::scene_for(mesh, meshes::elastic, meshes::settings(2));
    const SoilMap map(mesh, scene, "snapshot");
    EXPECT_THROW(ledger_of(mesh, points, map, scene, "snapshot"), fault::BadInput);
}

}  // namespace
}  // namespace breach::transfer
