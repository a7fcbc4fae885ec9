#include "services/templates/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace breach::templates {
namespace {

using nlohmann::json;

std::vector<fault::Fault> faults_of(const std::string& name, const json& options) {
    try {
        completed(named(name), options);
    } catch (const fault::BadInput& refusal) {
        return refusal.faults();
    }
    return {};
}

TEST(TemplateOptions, EveryDefaultLiesInItsRangeAndIsExplained) {
    for (const Template& each : catalogue()) {
        for (const Option& option : each.options) {
            EXPECT_GE(option.value, option.least) << each.name << " " << option.name;
            EXPECT_LE(option.value, option.most) << each.name << " " << option.name;
            EXPECT_FALSE(option.help.empty() || option.unit.empty()) << each.name << option.name;
        }
    }
}

TEST(TemplateOptions, DefaultsFollowTheHeight) {
    const Values values = completed(named("upstream_dam"), {{"height", 60}});
    EXPECT_DOUBLE_EQ(values["starter_height"], 20.0);
    EXPECT_DOUBLE_EQ(
        completed(named("upstream_dam"), {{"height", 60}, {"starter_height", 7}})["starter_height"],
        7.0);
}

TEST(TemplateOptions, EveryBadOneIsNamedWithItsRangeAtOnce) {
    const auto faults = faults_of(
        "upstream_dam", {{"height", -3}, {"raises", 1.5}, {"drain", "no"}, {"hight", 20}});
    std::vector<std::string> pointers;
    for (const fault::Fault& each : faults) pointers.push_back(each.pointer);
    std::ranges::sort(pointers);
    EXPECT_EQ(pointers, (std::vector<std::string>{"/drain", "/height", "/hight", "/raises"}));
    for (const fault::Fault& each : faults) {
        const std::string told = each.pointer == "/height"  ? "from 3 to 200 m"
                                 : each.pointer == "/hight" ? "starter_height"
                                                            : "";
        EXPECT_NE(each.remedy.find(told), std::string::npos) << each.remedy;
    }
}

TEST(TemplateOptions, ThatAreNoObjectAreRefused) {
    EXPECT_EQ(faults_of("slope", json::array()).size(), 1u);
    EXPECT_THROW(named("valley"), fault::BadInput);
}

}  // namespace
}  // namespace breach::templates
