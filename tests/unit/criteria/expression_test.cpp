#include <gtest/gtest.h>

#include <cmath>

#include "core/criteria/evaluation.hpp"
#include "core/criteria/ranges.hpp"
#include "core/fault/fault.hpp"

namespace breach::criteria {
namespace {

double value(const std::string& text, std::vector<double> fields = {}, Kind kind = Kind::quantity) {
    Evaluation evaluation(parse(text, kind, ""));
    return evaluation(0.0, fields);
}

double truth(const std::string& text, std::vector<double> fields = {}) {
    return value(text, std::move(fields), Kind::condition);
}

std::string complaint(const std::string& text, Kind kind = Kind::condition,
                      const std::vector<std::string>& known = {}) {
    try {
        parse(text, kind, "/triggers/0/when", known);
    } catch (const fault::BadInput& error) {
        EXPECT_EQ(error.faults().front().pointer, "/triggers/0/when");
        EXPECT_FALSE(error.faults().front().remedy.empty());
        return error.faults().front().cause;
    }
    return "no complaint";
}

TEST(Expression, ThatCanNeverBeTrueIsKnownFromTheRangesOfItsFields) {
    const auto can_be = [](const std::string& text) {
        return can_be_true(parse(text, Kind::condition, ""), [](const std::string& field) {
            return field == "share" ? Range{0.0, 1.0} : field == "time" ? Range{0.0, 9.0} : Range{};
        });
    };
    for (const char* never :
         {"share > 1", "share < 0", "1 < share", "share >= 1.01", "time > 9 and x > 0",
          "not (share >= 0)", "abs(share - 3) < 1.5", "share > 2 or time > 10",
          "max(share, -share) > 1", "min(share, x) > 1"})
        EXPECT_FALSE(can_be(never)) << never;
    for (const char* possible :
         {"share >= 1", "share <= 0", "x > 1e9", "share * 5 > 4", "rate(share, 1) > 9",
          "not (share > 0.5)", "time > 10 or x > 0", "max(share, x) > 1"})
        EXPECT_TRUE(can_be(possible)) << possible;
}

TEST(Expression, ArithmeticBindsAsInSchool) {
    EXPECT_DOUBLE_EQ(value("2 + 3 * 4"), 14);
    EXPECT_DOUBLE_EQ(value("(2 + 3) * 4"), 20);
    EXPECT_DOUBLE_EQ(value("8 - 3 - 2"), 3);
    EXPECT_DOUBLE_EQ(value("8 / 4 / 2"), 1);
    EXPECT_DOUBLE_EQ(value("-2 * -(1e-3 + .5)"), 1.002);
    EXPECT_DOUBLE_EQ(value("min(3, 2) + max(1, abs(-7))"), 9);
}

TEST(Expression, ConditionsJoinNotBeforeAndBeforeOr) {
    EXPECT_EQ(truth("1 < 2"), 1);
    EXPECT_EQ(truth("2 <= 2 and 2 >= 2"), 1);
    EXPECT_EQ(truth("1 > 2 or 1 < 2 and 3 < 2"), 0);
    EXPECT_EQ(truth("not 1 > 2 and 1 < 2"), 1);
    EXPECT_EQ(truth("not (1 < 2 or 1 > 2)"), 0);
}

TEST(Expression, FieldsAreSlotsInOrderOfAppearance) {
    const Expression e = parse("b < 2 * a and b > a", Kind::condition, "");
    EXPECT_EQ(e.fields, (std::vector<std::string>{"b", "a"}));
    EXPECT_EQ(truth("b < 2 * a and b > a", {3, 2}), 1);
    EXPECT_EQ(truth("b < 2 * a and b > a", {5, 2}), 0);
}

TEST(Expression, UnknownIsNeverTrue) {
    EXPECT_TRUE(std::isnan(truth("x < 1", {NAN})));
    EXPECT_TRUE(std::isnan(truth("not x < 1", {NAN})));
    EXPECT_EQ(truth("x < 1 and 2 < 1", {NAN}), 0);
    EXPECT_EQ(truth("x < 1 or 1 < 2", {NAN}), 1);
    EXPECT_TRUE(std::isnan(value("min(1, x)", {NAN})));
    EXPECT_TRUE(std::isnan(value("max(x, 1)", {NAN})));
}

TEST(Expression, GrowthOfAnExponentialIsItsRate) {
    Evaluation growth(parse("growth(E, 0.1)", Kind::quantity, ""));
    Evaluation rate(parse("rate(E, 0.1)", Kind::quantity, ""));
    for (int i = 0; i <= 100; ++i) {
        const double t = 0.01 * i;
        const double E = 2 * std::exp(3 * t);
        const double g = growth(t, std::vector{E});
        const double r = rate(t, std::vector{5 * t});
        if (i < 10) {
            EXPECT_TRUE(std::isnan(g)) << t;  // the window is not filled yet
        } else {
            EXPECT_NEAR(g, 3, 1e-9) << t;  // samples fall on the window's begin: rounding only
            EXPECT_NEAR(r, 5, 1e-9) << t;
        }
    }
}

TEST(Expression, WindowInterpolatesBetweenUnevenLines) {
    Evaluation rate(parse("rate(x, 0.5)", Kind::quantity, ""));
    double t = 0, last = 0;
    for (const double dt : {0.3, 0.07, 0.4, 0.11, 0.5, 0.02}) {
        t += dt;
        last = rate(t, std::vector{7 * t - 1});
    }
    EXPECT_NEAR(last, 7, 1e-12);  // a line is reproduced exactly
}

TEST(Expression, GrowthFromZeroIsUnknownNotInfinite) {
    Evaluation growth(parse("growth(E, 0.1)", Kind::quantity, ""));
    growth(0.0, std::vector{0.0});
    EXPECT_TRUE(std::isnan(growth(0.1, std::vector{1.0})));
}

TEST(Expression, ComplaintsNameColumnAndCause) {
    EXPECT_EQ(complaint("a < "),
              "column 5: a number or a telemetry field was expected, not 'the end'");
    EXPECT_EQ(complaint("a + 1"), "column 1: this is a number, but a condition is needed");
    EXPECT_EQ(complaint("(a < 1) + 2 < 3"),
              "column 1: this is a condition, but a number is needed");
    EXPECT_EQ(complaint("a < 1 b"), "column 7: 'b' was not expected");
    EXPECT_EQ(complaint("a = 1"), "column 3: the character '=' has no meaning here");
    EXPECT_EQ(complaint("a < 1 and"),
              "column 10: a number or a telemetry field was expected, not 'the end'");
    EXPECT_EQ(complaint("(a < 1"), "column 7: ')' was expected, not 'the end'");
    EXPECT_EQ(complaint("sin(a) < 1"), "column 1: there is no function 'sin'");
    EXPECT_EQ(complaint("growth(a, b) < 1"),
              "column 11: the window must be a number of seconds above zero");
    EXPECT_EQ(complaint("jacobain < 1", Kind::condition, {"time", "jacobian"}),
              "column 1: there is no telemetry field 'jacobain'");
    EXPECT_EQ(complaint("1 < 2 < 3"), "column 7: '<' was not expected");
    EXPECT_EQ(complaint("1e999 < 2"), "column 1: is not a number");
    EXPECT_EQ(complaint(""), "column 1: a number or a telemetry field was expected, not 'the end'");
}

TEST(Expression, DeepAndLongTextsAreRefused) {
    EXPECT_NE(complaint(std::string(3000, '(')).find("nested too deeply"), std::string::npos);
    EXPECT_NE(complaint(std::string(3000, '-') + "1 < 2").find("nested too deeply"),
              std::string::npos);
    EXPECT_NE(complaint(std::string(100000, ' ') + "1 < 2").find("too long"), std::string::npos);
    std::string nots;
    for (int i = 0; i < 900; ++i) nots += "not ";
    EXPECT_NE(complaint(nots + "1 < 2").find("nested too deeply"), std::string::npos);
}

}  // namespace
}  // namespace breach::criteria
