// Motion files, used in Mochikoshi's scene, refused or accepted.
#include <cmath>
#include <filesystem>

#include "wrong.hpp"

namespace breach::check {
namespace {

class Motion : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) /
                  ("motion_" +
                   std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Checked with(const std::string& name, const std::string& text,
                 std::vector<std::string> overrides = {}) {
        const auto file = folder_ / name;
        std::ofstream(file) << text;
        overrides.insert(overrides.begin(), R"(/fem/motion={"file":")" + file.string() + R"("})");
        return changed("mochikoshi", overrides);
    }

    /// A shaking of 12 s that ends at rest.
    static std::string rows(double dt, double peak, int count = 1200) {
        std::string text;
        for (int i = 0; i < count; ++i) {
            const double share = static_cast<double>(i) / (count - 1);
            const double value =
                peak * std::sin(M_PI * share) * std::cos(40.0 * M_PI * (share - 0.5));
            text += std::to_string(dt * i) + "," + std::to_string(value) + "\n";
        }
        return text;
    }

    std::filesystem::path folder_;
};

const std::string header = "time_s,acceleration_g\n";

TEST_F(Motion, ASoundOneIsTaken) {
    const Checked checked = with("sound.csv", header + rows(0.01, 0.3));
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
}

/// rows() swings at 20 / 12 Hz.
TEST_F(Motion, DampingIsGivenAtAFrequencyThatTheMotionHas) {
    const auto damped = [&](const std::string& damping, std::vector<std::string> more = {}) {
        more.push_back("/fem/damping=" + damping);
        return with("sound.csv", header + rows(0.01, 0.3), more);
    };
    const Checked checked = damped(R"({"ratio":0.005,"frequency_Hz":3})");
    ASSERT_TRUE(checked.faults.empty()) << told(checked.faults);
    EXPECT_NEAR(checked.scene.fem->rayleigh_stiffness, 0.005 / (M_PI * 3.0), 1e-15);
    for (const char* frequency : {"0.01", "30"})
        expect_only(damped(R"({"ratio":0.005,"frequency_Hz":)" + std::string(frequency) + "}"),
                    "/fem/damping/frequency_Hz", "the motion has its power from 1.");
    expect_only(damped(R"({"ratio":-0.005,"frequency_Hz":3})"), "/fem/damping/ratio", "");
    expect_only(damped(R"({"ratio":0.5,"frequency_Hz":3})"), "/fem/damping/ratio", "0.5");
    expect_only(damped(R"({"ratio":0.005,"frequency_Hz":3})", {"/fem/rayleigh_stiffness=1e-3"}),
                "/fem/damping", "twice");
}

TEST_F(Motion, AFileThatIsNotThereIsNamed) {
    expect_only(changed("mochikoshi", {"/fem/motion/file=/nowhere/motion.csv"}), "/fem/motion/file",
                "does not exist: /nowhere/motion.csv");
    expect_only(changed("mochikoshi", {"/fem/motion/file=/tmp"}), "/fem/motion/file",
                "is a folder");
    expect_only(changed("mochikoshi", {"/fem/motion/file=/dev/zero"}), "/fem/motion/file",
                "cannot open");
    expect_only(changed("mochikoshi", {"/fem/motion/file=/" + std::string(5000, 'a')}),
                "/fem/motion/file", "does not exist");
}

TEST_F(Motion, ColumnsHeaderAndNumbersAreRead) {
    expect_only(with("a.csv", "t,a\n" + rows(0.01, 0.3)), "/fem/motion/file",
                "line 1: is no known header");
    expect_only(with("b.csv", "time_s,acceleration_mg\n" + rows(0.01, 0.3)), "/fem/motion/file",
                "is no known header");
    expect_only(with("c.csv", header + "0,0,0\n0.01,0.1,0.1\n"), "/fem/motion/file",
                "line 2: has 3 columns");
    expect_only(with("d.csv", header + "0,0\n0.01,none\n"), "/fem/motion/file",
                "line 3: 'none' is not a finite number");
    expect_only(with("e.csv", header + "0,0\n0.01,0.1\n0.05,0\n"), "/fem/motion/file",
                "not equally spaced");
    expect_only(with("f.csv", header), "/fem/motion/file", "fewer than two samples");
    expect_only(with("g.at2", "PEER\ntitle\nACCELERATION IN UNITS OF CM\nNPTS= 2, DT= .01\n0 1\n"),
                "/fem/motion/file", "names no known unit");
}

TEST_F(Motion, ZerosAreFlagged) {
    const Checked checked = with("zero.csv", header + "0,0\n0.01,0\n0.02,0\n");
    EXPECT_TRUE(checked.faults.empty()) << told(checked.faults);
    EXPECT_TRUE(has_warning(checked, "implausible", "/fem/motion/file"));
}

TEST_F(Motion, OneConstantValueIsRefused) {
    expect_only(with("constant.csv", header + "0,0.2\n0.01,0.2\n0.02,0.2\n"), "/fem/motion/file",
                "one constant value, 1.96");
}

TEST_F(Motion, TimesInMillisecondsAreNamed) {
    const Checked checked = with("ms.csv", header + rows(10.0, 0.3));
    expect_only(checked, "/fem/motion/file", "a time step of 10 s");
    EXPECT_NE(checked.faults[0].remedy.find("looks like milliseconds"), std::string::npos);
}

TEST_F(Motion, PeaksBeyondThePossibleAreRefusedAndBeyondTheUsualFlagged) {
    expect_only(with("much.csv", header + rows(0.01, 6.0)), "/fem/motion/file", "a PGA of 5.99");
    const Checked unusual = with("unusual.csv", header + rows(0.01, 1.96));
    EXPECT_TRUE(unusual.faults.empty()) << told(unusual.faults);
    EXPECT_TRUE(has_warning(unusual, "implausible", "/fem/motion/file"));
    EXPECT_TRUE(has_warning(with("small.csv", "time_s,acceleration_m_s2\n" + rows(0.01, 0.03)),
                            "implausible", "/fem/motion/file"));
    expect_only(with("velocity.csv", "time_s,velocity_m_s\n" + rows(0.01, 30.0)),
                "/fem/motion/file", "a peak velocity of");
}

TEST_F(Motion, ADisplacementAndAScaledVelocityCannotBeApplied) {
    expect_only(
        with("d.dt2", "PEER\ntitle\nDISPLACEMENT IN UNITS OF CM\nNPTS= 3, DT= .01\n0 1 0\n"),
        "/fem/motion/file", "is a displacement");
    expect_only(with("v.csv", "time_s,velocity_m_s\n" + rows(0.01, 0.3),
                     {"/fem/motion/scale_to_pga_g=0.3"}),
                "/fem/motion/scale_to_pga_g", "the file holds a velocity");
}

TEST_F(Motion, StagesThatEndBeforeTheShakingOrStepOverItAreFlagged) {
    EXPECT_TRUE(has_warning(with("cut.csv", header + rows(0.01, 0.3),
                                 {"/fem/stages/2/duration=3", "/fem/snapshot_times=[]"}),
                            "motion_cut", "/fem/stages"));
    EXPECT_TRUE(
        has_warning(with("coarse.csv", header + rows(0.01, 0.3), {"/fem/stages/2/time_step=0.1"}),
                    "coarse_step", "/fem/stages/2/time_step"));
}

TEST_F(Motion, AResidualVelocityIsFlagged) {
    std::string text = header;
    for (int i = 0; i < 1200; ++i) text += std::to_string(0.01 * i) + (i < 600 ? ",0.1\n" : ",0\n");
    EXPECT_TRUE(has_warning(with("drift.csv", text), "drifting_motion", "/fem/motion/file"));
}

}  // namespace
}  // namespace breach::check
