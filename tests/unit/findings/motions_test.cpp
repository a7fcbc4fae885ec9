#include "services/findings/motions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace {

using namespace breach;
using findings::Shaken;
using nlohmann::json;

Shaken shaken(int number, double pgv, double depth, std::optional<double> runout) {
    const double other = 1.0 + number * 7 % 13;
    return {"m" + std::to_string(number),
            {other, pgv, other, other, other, other, other},
            depth,
            runout};
}

const json& measure(const json& found, const std::string& name) {
    for (const json& each : found.at("measures"))
        if (each.at("name") == name) return each;
    throw std::runtime_error(name);
}

/// Depth 20 pgv, runout from 10 m of it on, 100 m from 18 m on.
std::vector<Shaken> clean() {
    std::vector<Shaken> all;
    for (int k = 0; k < 25; ++k) {
        const double pgv = 0.04 * (k + 1), depth = 20.0 * pgv;
        all.push_back(shaken(k, pgv, depth, std::clamp((depth - 10.0) / 8.0, 0.0, 1.0) * 100.0));
    }
    return all;
}

TEST(Motions, FindTheMeasureThatDepthFollows) {
    const json found = findings::motions_of(clean());
    EXPECT_EQ(found.at("best"), "pgv");
    EXPECT_NEAR(measure(found, "pgv").at("with_depth").at("value").get<double>(), 1.0, 1e-12);
    EXPECT_LT(std::abs(measure(found, "pga_g").at("with_depth").at("value").get<double>()), 0.5);
}

TEST(Motions, FindOnsetAndSaturation) {
    const json found = findings::motions_of(clean());
    EXPECT_EQ(found.at("onset").at("wrong"), 0);
    EXPECT_NEAR(found.at("onset").at("depth").get<double>(), 10.4, 0.41);
    EXPECT_NEAR(found.at("saturation").at("depth").get<double>(), 17.6, 1e-9) << "95 m of 100";
    EXPECT_NEAR(found.at("saturation").at("runout").get<double>(), 100.0, 1e-9);
}

TEST(Motions, SayThatOneValueParts) {
    EXPECT_TRUE(measure(findings::motions_of(clean()), "pgv").at("fragility").contains("refused"));
}

/// Numbers of exceedances by level for a lognormal curve with median 0.5 and beta 0.4, rounded to
/// motions.
TEST(Motions, FitTheFragilityCurveThatMadeThem) {
    std::vector<Shaken> all;
    for (const double pgv : {0.2, 0.3, 0.4, 0.5, 0.625, 0.8, 1.2}) {
        const double p = 0.5 * std::erfc(-std::log(pgv / 0.5) / 0.4 / std::sqrt(2.0));
        for (int k = 0; k < 200; ++k)
            all.push_back(shaken(k, pgv, pgv, k + 0.5 < 200.0 * p ? 1.0 : 0.0));
    }
    const json curve = measure(findings::motions_of(all), "pgv").at("fragility");
    EXPECT_NEAR(curve.at("median").get<double>(), 0.5, 0.005);
    EXPECT_NEAR(curve.at("beta").get<double>(), 0.4, 0.01);
    EXPECT_LT(curve.at("low"), curve.at("median"));
    EXPECT_NEAR(curve.at("high").get<double>() * curve.at("low").get<double>(),
                std::pow(curve.at("median").get<double>(), 2), 1e-9);
}

TEST(Motions, RefuseWhereAllOrNoneRun) {
    auto all = clean();
    for (Shaken& each : all) each.runout = 0.0;
    const json none = findings::motions_of(all);
    EXPECT_TRUE(none.at("onset").is_null());
    EXPECT_TRUE(none.at("saturation").is_null());
    EXPECT_EQ(measure(none, "pgv").at("fragility").at("refused"),
              "no motion sends soil past the toe");
    for (Shaken& each : all) each.runout = std::nullopt;
    const json unknown = findings::motions_of(all);
    EXPECT_EQ(unknown.at("sentences").at(0),
              "0 of 0 motions send soil past the toe. Without a runout: 25.");
}

}  // namespace
