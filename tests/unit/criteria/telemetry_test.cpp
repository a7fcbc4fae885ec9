#include "core/criteria/telemetry.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "core/fault/fault.hpp"

namespace breach::criteria {
namespace {

class Telemetry : public testing::Test {
  protected:
    Telemetry() : file_("/tmp/breach_telemetry_" + std::to_string(::getpid()) + ".jsonl") {}
    ~Telemetry() override { std::filesystem::remove(file_); }
    std::vector<TelemetryLine> of(const std::string& text) {
        std::ofstream(file_) << text;
        return read_telemetry(file_);
    }
    std::filesystem::path file_;
};

TEST_F(Telemetry, TakesNumbersByNameAndLeavesOutWhatIsNotWholeOrNotLater) {
    const auto lines = of(R"({"time":0.5,"step":3,"phase":"fem_solver","energy":2}
{"time":0.5,"energy":9}
{"time":1.0,"energy":4,"depth":7}
{"time":1.5,"ener)");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].step, 3);
    EXPECT_EQ(lines[1].values.at("depth"), 7.0);
    EXPECT_FALSE(lines[0].values.contains("phase"));
    const auto energy_and_depth = parse("energy > 1 and depth > 2", Kind::condition, "");
    const Line line = line_for(energy_and_depth, lines[0]);
    ASSERT_EQ(line.values.size(), 2u);
    EXPECT_EQ(line.values[0] + (std::isnan(line.values[1]) ? 0.0 : 100.0), 2.0);
}

TEST_F(Telemetry, ALineThatIsNoJsonIsRefusedByItsNumberUnlessItIsStillBeingWritten) {
    try {
        of("{\"time\":0.5}\n{\"time\":1.0,\"energy\":NaN}\n{\"time\":1.5}\n");
        FAIL();
    } catch (const fault::BadInput& refusal) {
        EXPECT_EQ(refusal.faults().at(0).pointer, "line 2");
    }
    EXPECT_EQ(of("{\"time\":0.5}\n{\"time\":1.0,\"ene").size(), 1u);
}

TEST_F(Telemetry, AStepThatIsNoWholeNumberIsNone) {
    EXPECT_EQ(of(R"({"time":1,"step":1e300})").at(0).step, 0);
}

TEST_F(Telemetry, WithoutTimesOrWithoutAFileIsRefused) {
    EXPECT_THROW(of("{\"energy\":1}\n"), fault::BadInput);
    EXPECT_THROW(read_telemetry("/nowhere/telemetry.jsonl"), fault::IoError);
}

}  // namespace
}  // namespace breach::criteria
