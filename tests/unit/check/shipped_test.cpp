// All shipped scenes pass, fast enough for a check at every submission.
#include "wrong.hpp"

namespace breach::check {
namespace {

TEST(Shipped, ScenesHaveNoFaults) {
    for (const char* scene : {"column", "slope", "mochikoshi", "mochikoshi_runout"}) {
        const Checked checked = changed(scene, {});
        EXPECT_TRUE(checked.faults.empty()) << scene << ":\n" << told(checked.faults);
        for (const fault::Flag& each : checked.scene.warnings)
            EXPECT_TRUE(each.code.starts_with("coarse_") || each.code == "wide_band")
                << scene << " warns: " << each.pointer << ": " << each.message;
    }
}

}  // namespace
}  // namespace breach::check
