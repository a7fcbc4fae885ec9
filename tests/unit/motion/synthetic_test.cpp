// The synthetic motion meets its targets, and the shipped file is one.
#include "core/motion/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/fault/fault.hpp"
#include "core/motion/read_motion.hpp"

namespace breach::motion {
namespace {

/// Like San Fernando 1971 at Hollywood Storage, scaled to 0.3 g.
constexpr Target shipped{.peak_acceleration = 0.3 * standard_gravity,
                         .peak_velocity = 0.256,
                         .strong_duration = 11.16,
                         .arias_intensity = 1.33,
                         .length = 28.0,
                         .dt = 0.01,
                         .seed = 1978};

TEST(SyntheticMotion, MeetsAllItsTargets) {
    for (const std::uint64_t seed : {1978u, 1u, 2u, 3u}) {
        Target target = shipped;
        target.seed = seed;
        const Series a = synthetic_motion(target);
        const Baseline left = baseline(a);
        std::printf("    seed %4d: PGA %.4f g, PGV %.2f cm/s, D5-95 %.2f s, Arias %.3f m/s\n",
                    static_cast<int>(seed), peak(a) / standard_gravity, 100 * peak(integral(a)),
                    strong_part(a).duration(), arias_intensity(a));
        EXPECT_NEAR(peak(a) / target.peak_acceleration, 1.0, 1e-12);
        EXPECT_NEAR(peak(integral(a)) / target.peak_velocity, 1.0, 0.01);
        EXPECT_NEAR(strong_part(a).duration() / target.strong_duration, 1.0, 0.01);
        EXPECT_NEAR(arias_intensity(a) / target.arias_intensity, 1.0, 0.01);
        EXPECT_LT(left.velocity_share, 1e-10);
    }
}

TEST(SyntheticMotion, SaysWhenTargetsContradict) {
    Target target = shipped;
    target.arias_intensity = 100.0;
    target.length = 4.0;
    target.dt = 0.02;
    EXPECT_THROW(synthetic_motion(target), fault::BadInput);
}

struct Shipped {
    const char* file;
    double strong_duration, arias_intensity, length;
    std::uint64_t seed;
};

TEST(ShippedMotions, AreTheGeneratorsOwn) {
    for (const Shipped& each : {Shipped{"synthetic.csv", 11.16, 1.33, 28.0, 1978},
                                Shipped{"synthetic_1979.csv", 11.16, 1.33, 28.0, 1979},
                                Shipped{"synthetic_short.csv", 5.0, 0.7, 16.0, 1980},
                                Shipped{"synthetic_long.csv", 20.0, 2.0, 45.0, 1981}}) {
        Target target = shipped;
        target.strong_duration = each.strong_duration;
        target.arias_intensity = each.arias_intensity;
        target.length = each.length;
        target.seed = each.seed;
        const auto file = std::filesystem::path(BREACH_ROOT) / "workflows/motions" / each.file;
        const Series given = read_motion(file).series, made = synthetic_motion(target);
        ASSERT_EQ(given.values.size(), made.values.size()) << each.file;
        double difference = 0.0;
        for (std::size_t i = 0; i < made.values.size(); ++i) {
            difference = std::max(difference, std::abs(given.values[i] - made.values[i]));
        }
        EXPECT_LT(difference, 1e-6) << each.file;  // eight decimals of g in the file
    }
}

}  // namespace
}  // namespace breach::motion
