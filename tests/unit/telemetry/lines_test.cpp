#include "core/telemetry/lines.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/fault/fault.hpp"

namespace breach::telemetry {
namespace {

class Lines : public testing::Test {
  protected:
    Lines() : file_("/tmp/breach_telemetry_" + std::to_string(::getpid()) + ".jsonl") {}
    ~Lines() override { std::filesystem::remove(file_); }
    std::vector<Line> of(const std::string& text) {
        std::ofstream(file_) << text;
        return read(file_);
    }
    std::string refused(const std::string& text) {
        try {
            of(text);
        } catch (const fault::BadInput& refusal) {
            return refusal.faults().at(0).pointer;
        }
        return "taken";
    }
    std::filesystem::path file_;
};

constexpr const char* course = R"({"time":0.5,"step":3,"phase":"fem_solver","energy":2}
{"time":0.5,"energy":9}
{"time":1.0,"energy":4,"depth":7}
{"time":1.5,"ener)";

TEST_F(Lines, HoldNumbersByNameWithoutWhatIsNotWholeOrNotLater) {
    const auto lines = of(course);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].step, 3);
    EXPECT_EQ(lines[0].values.at("energy"), 2.0);
    EXPECT_EQ(lines[1].values.at("depth"), 7.0);
    EXPECT_FALSE(lines[0].values.contains("phase"));
}

TEST_F(Lines, WatchedWhileTheyGrowAreTheSameEachOnce) {
    const auto whole = of(std::string(course) + "gy\":1}\n");
    std::filesystem::remove(file_);
    Tail tail(file_);
    EXPECT_TRUE(tail.fresh().empty()) << "no file yet";
    std::ofstream(file_) << course;
    auto seen = tail.fresh();
    EXPECT_EQ(seen.size(), 2u) << "the torn line waits";
    std::ofstream(file_, std::ios::app) << "gy\":1}\n";
    for (Line& line : tail.fresh()) seen.push_back(std::move(line));
    EXPECT_TRUE(tail.fresh().empty());
    ASSERT_EQ(seen.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(seen[i].time, whole[i].time);
        EXPECT_EQ(seen[i].values, whole[i].values);
    }
}

TEST_F(Lines, WatchedOfAFileThatWasBegunAgainAreOnlyTheLaterOnes) {
    std::ofstream(file_) << "{\"time\":1,\"a\":1}\n{\"time\":2,\"a\":1}\n";
    Tail tail(file_);
    EXPECT_EQ(tail.fresh().size(), 2u);
    std::ofstream(file_) << "{\"time\":2}\n{\"time\":3}\n";
    const auto fresh = tail.fresh();
    ASSERT_EQ(fresh.size(), 1u);
    EXPECT_EQ(fresh[0].time, 3.0);
}

TEST_F(Lines, WithoutATimeOrThatAreNoJsonAreRefusedByTheirNumberUnlessStillBeingWritten) {
    EXPECT_EQ(refused("{\"time\":0.5}\n{\"time\":1.0,\"energy\":NaN}\n{\"time\":1.5}\n"), "line 2");
    EXPECT_EQ(refused("{\"time\":0.5}\n{\"energy\":1}\n"), "line 2");
    EXPECT_EQ(refused("[1]\n"), "line 1");
    EXPECT_EQ(of("{\"time\":0.5}\n{\"time\":1.0,\"ene").size(), 1u);
}

TEST_F(Lines, TakeALastOneThatOnlyLacksItsLineBreak) {
    EXPECT_EQ(of("{\"time\":0.5}\n{\"time\":1.0}").size(), 2u);
}

TEST_F(Lines, HaveNoStepWhereItIsNoWholeNumber) {
    EXPECT_EQ(of(R"({"time":1,"step":1e300})").at(0).step, 0);
}

TEST_F(Lines, OfAnEmptyFileAreNoneAndOfNoFileARefusal) {
    EXPECT_TRUE(of("").empty());
    EXPECT_THROW(read("/nowhere/telemetry.jsonl"), fault::IoError);
    EXPECT_THROW(read("/tmp"), fault::IoError);
}

}  // namespace
}  // namespace breach::telemetry
