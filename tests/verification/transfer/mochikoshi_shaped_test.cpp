// The shipped Mochikoshi scene's transfer on a snapshot of its shape. What the numbers are is
// invented; that nothing is lost is not.
#include "tests/verification/transfer/mochikoshi_shaped.hpp"

#include <gtest/gtest.h>

namespace breach::transfer::mochikoshi_shaped_test {
namespace {

class MochikoshiShaped : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const std::string root = BREACH_ROOT;
        scene_ = new scene::Scene(scene::read_scene(root + "/workflows/scenes/mochikoshi.json"));
        mesh_ = new exchange::MeshSnapshot(mochikoshi::snapshot(
            *scene_, root + "/tests/verification/transfer/mochikoshi_mesh24.json"));
        transferred_ = new Transferred(*transfer(*mesh_, *scene_, {.threads = 2}, "snapshot"));
    }
    static void TearDownTestSuite() {
        delete transferred_;
        delete mesh_;
        delete scene_;
    }
    static double difference(const std::string& quantity) {
        return std::abs(meshes::row_of(transferred_->ledger, "total", quantity).difference);
    }
    static inline scene::Scene* scene_ = nullptr;
    static inline exchange::MeshSnapshot* mesh_ = nullptr;
    static inline Transferred* transferred_ = nullptr;
};

// The limits: 1e-12, 1e-10, and 0.5 % of the kinetic energy.
TEST_F(MochikoshiShaped, KeepsMassVolumeMomentumAndEnergy) {
    std::cout << as_text(transferred_->ledger);
    EXPECT_LT(difference("mass"), 1e-12);
    EXPECT_LT(difference("volume"), 1e-12);
    EXPECT_LT(difference("momentum x"), 1e-10);
    EXPECT_LT(difference("momentum y"), 1e-10);
    EXPECT_LT(difference("kinetic energy"), 0.005);
    EXPECT_LT(difference("potential energy"), 1e-12);
    EXPECT_NO_THROW(refuse_losses(transferred_->ledger, *scene_->transfer));
}

TEST_F(MochikoshiShaped, EveryFilledCellGetsItsFourPointsBesideTenMetreElements) {
    ASSERT_TRUE(transferred_->supply.has_value());
    EXPECT_GT(transferred_->supply->filled, 500u);
    EXPECT_GE(transferred_->supply->least_in_filled, 4u);
    EXPECT_EQ(transferred_->supply->short_cells, 0u);
}

TEST_F(MochikoshiShaped, LiquefiedLayersAndWetDamsAreThereAndTheirMassAddsUp) {
    double mass = 0.0;
    std::vector<std::string> materials;
    for (const SoilShare& each : transferred_->shares) {
        mass += each.mass;
        materials.push_back(transferred_->soils[each.soil].material);
        EXPECT_EQ(transferred_->soils[each.soil].stress, exchange::StressMeasure::total);
    }
    const double whole = meshes::row_of(transferred_->ledger, "total", "mass").after;
    EXPECT_NEAR(mass / whole, 1.0, 1e-12);
    for (const char* each : {"liquefied_1", "liquefied_2", "liquefied_3", "embankment_saturated",
                             "embankment_unsaturated", "tailings_not_liquefied"})
        EXPECT_EQ(std::ranges::count(materials, each) > 0, true) << each;
    EXPECT_GT(transferred_->liquefaction->nodes, 100u);
    EXPECT_NEAR(transferred_->liquefaction->deepest_level, 29.4 - 18.5, 3.0) << "one element";
}

}  // namespace
}  // namespace breach::transfer::mochikoshi_shaped_test
