// Measures of a series, against closed forms and a record's own integral.
#include "core/motion/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "core/motion/read_motion.hpp"

namespace breach::motion {
namespace {

using std::numbers::pi;

Series sine(double dt, double length, double amplitude, double frequency) {
    Series s{dt, {}};
    for (int i = 0; i * dt <= length + 1e-12; ++i) {
        s.values.push_back(amplitude * std::sin(2.0 * pi * frequency * i * dt));
    }
    return s;
}

TEST(Sine, HasItsClosedFormMeasures) {
    const double A = 3.0, f = 2.0, T = 5.0;
    const Series a = sine(0.001, T, A, f);
    EXPECT_NEAR(peak(a), A, 1e-5);
    // v = A / (2 pi f) (1 - cos): peak A / (pi f). Trapezoid: relative error (2 pi f dt)^2 / 12.
    EXPECT_NEAR(peak(integral(a)) / (A / (pi * f)), 1.0, 2e-5);
    const double exact = 0.5 * pi / standard_gravity * 0.5 * A * A * T;
    EXPECT_NEAR(arias_intensity(a) / exact, 1.0, 1e-9);
    EXPECT_NEAR(strong_part(a).duration() / (0.9 * T), 1.0, 0.01);
}

TEST(Scaling, MeetsThePeakAndLeavesZeroAlone) {
    EXPECT_DOUBLE_EQ(peak(scaled_to_peak(sine(0.01, 1, 0.2, 3), 2.943)), 2.943);
    EXPECT_EQ(peak(scaled_to_peak({0.01, {0.0, 0.0}}, 2.943)), 0.0);
}

TEST(ValueAt, IsLinearBetweenSamplesAndZeroBeyondThem) {
    const Series series{0.02, {0.0, 2.0, 4.0, 0.0}};
    EXPECT_DOUBLE_EQ(value_at(series, 0.005), 0.5);
    EXPECT_DOUBLE_EQ(value_at(series, 0.055), 1.0);
    EXPECT_EQ(value_at(series, -0.001), 0.0);
    EXPECT_EQ(value_at(series, 0.0601), 0.0);
    EXPECT_DOUBLE_EQ(value_at({0.1, {1.0, 5.0}}, 0.1), 5.0);
}

TEST(BaseCorrection, LeavesTheGroundAtRest) {
    Series a = sine(0.01, 7.3, 2.0, 1.3);
    for (double& value : a.values) value += 0.05;
    EXPECT_GT(baseline(a).velocity_share, 0.5);
    const Baseline left = baseline(base_corrected(a));
    EXPECT_LT(std::abs(left.last_velocity), 1e-13);
    EXPECT_LT(std::abs(left.last_displacement), 1e-12);
}

TEST(Record88, IntegratesToItsOwnVelocity) {
    const std::filesystem::path folder = std::filesystem::path(BREACH_SHARED) / "motions";
    const auto file = [&](const char* ending) {
        return folder / (std::string("RSN88_SFERN_FSD172.") + ending);
    };
    if (!std::filesystem::exists(file("AT2"))) GTEST_SKIP() << "no records at " << folder;
    const Series a = read_motion(file("AT2")).series;
    const Series given = read_motion(file("VT2")).series;
    Series v = integral(a);
    ASSERT_EQ(v.values.size(), given.values.size());
    double difference = 0.0;
    for (std::size_t i = 0; i < v.values.size(); ++i) {
        difference = std::max(difference, std::abs(v.values[i] - given.values[i]));
    }
    std::printf("    PGA %.5f g, PGV %.3f cm/s (record's %.3f), Arias %.3f m/s, D5-95 %.2f s\n",
                peak(a) / standard_gravity, 100 * peak(v), 100 * peak(given), arias_intensity(a),
                strong_part(a).duration());
    // PEER uses g = 9.81 (3.4e-4 more), and its filtered velocity starts from rest like ours.
    std::printf("    largest difference of velocity %.3e of PGV, allowed 1e-3\n",
                difference / peak(given));
    EXPECT_LT(difference, 1e-3 * peak(given));
    EXPECT_NEAR(peak(a) / standard_gravity, 0.15487, 5e-6);
    EXPECT_NEAR(strong_part(a).duration(), 23.61, 0.02);
}

/// The power of two sines is proportional to their amplitudes squared; of wide-band noise it is
/// flat.
TEST(Series, BandIsWhereThePowerLies) {
    Series motion{0.01, {}};
    for (int i = 0; i < 4000; ++i) {
        const double t = 0.01 * i;
        motion.values.push_back(std::sin(2.0 * M_PI * t) + 0.5 * std::sin(2.0 * M_PI * 8.0 * t));
    }
    const Band two = band(motion);
    EXPECT_NEAR(two.low, 1.0, 0.06);
    EXPECT_NEAR(two.high, 8.0, 0.06);
}

TEST(AllRecords, CanBeRead) {
    const std::filesystem::path folder = std::filesystem::path(BREACH_SHARED) / "motions";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no records at " << folder;
    struct Known {
        const char* file;
        double pga, arias;
    };
    for (const Known& known :
         {Known{"SFERN1971_LA_Hollywood_Stor_180_P695-121512.txt", 0.17418, 0.447},
          Known{"NORTHR1994_ARL360.at2", 0.30806, 1.171},
          Known{"IMPVALL1940_ELC180.AT2", 0.31288, 1.703},
          Known{"KOBE1995_NIS090.AT2", 0.50275, 2.268}}) {
        const Series a = read_motion(folder / known.file).series;
        EXPECT_NEAR(peak(a) / standard_gravity, known.pga, 1e-5) << known.file;
        EXPECT_NEAR(arias_intensity(a), known.arias, 1e-3) << known.file;
    }
}

}  // namespace
}  // namespace breach::motion
