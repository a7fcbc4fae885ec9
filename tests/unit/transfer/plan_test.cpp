#include <gtest/gtest.h>

#include <algorithm>

#include "transfer_tool/run.hpp"

namespace breach::transfer {
namespace {

process::PlanLine interpolation_of(const std::vector<std::string>& overrides) {
    const scene::Scene scene =
        scene::read_scene(BREACH_ROOT "/workflows/scenes/column.json", overrides);
    const process::Plan lines = plan(scene);
    return *std::ranges::find(lines, "radial basis functions", &process::PlanLine::feature);
}

TEST(TransferPlan, PointsThatAreMovedOffTheGaussPointsAreInterpolated) {
    EXPECT_EQ(interpolation_of({}).use, process::Use::left_out);
    const process::PlanLine moved = interpolation_of({"/transfer/point_shift=[0.25,0]"});
    EXPECT_EQ(moved.use, process::Use::on);
    EXPECT_EQ(moved.pointer, "/transfer/point_shift");
    EXPECT_EQ(interpolation_of({"/transfer/points_per_direction=3"}).use, process::Use::on);
}

}  // namespace
}  // namespace breach::transfer
