#include "services/orchestrator/records/same_results.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace breach::orchestrator::same_results_test {
namespace {

using nlohmann::json;

ResultRow row(const char* variant, json t_T, json runout, double safety = 1.2) {
    ResultRow values;
    for (const ResultColumn& column : result_columns()) {
        const std::string_view name = column.name;
        values.push_back(name == "variant"            ? json(variant)
                         : name == "transfer_time"    ? t_T
                         : name == "runout"           ? runout
                         : name == "factor_of_safety" ? json(safety)
                         : name == "cpu_seconds"      ? json(values.size() * runout.dump().size())
                                                      : json());
    }
    return values;
}

using Groups = std::vector<std::vector<std::string>>;
const std::vector<std::string> names{"a", "b", "c"};

TEST(SameResults, AreThoseOfVariantsThatAgreeToTheLastDigitWhereverBothHaveEnded) {
    EXPECT_EQ(
        same_results({row("a", 1, 50.0), row("b", 1, 50.0), row("c", 1, 50.0 + 1e-13)}, names),
        (Groups{{"a", "b"}}));
    EXPECT_EQ(same_results({row("a", 1, 50.0), row("a", 2, 60.0), row("b", 1, 50.0),
                            row("b", 2, nullptr), row("c", 1, 50.0), row("c", 2, 61.0)},
                           names),
              (Groups{{"a", "b"}}))
        << "c differs at 2 s, b has not ended there";
    EXPECT_EQ(same_results({row("a", nullptr, 50.0), row("b", nullptr, 50.0, 1.3)}, names),
              Groups{})
        << "the factor of safety is told apart";
}

TEST(SameResults, AreNoneOfWhatHasNotEndedOrIsADrawOfAnother) {
    EXPECT_EQ(same_results({row("a", 1, nullptr), row("b", 1, nullptr)}, names), Groups{});
    EXPECT_EQ(same_results({row("a", 1, 50.0), row("b", 2, 50.0)}, names), Groups{});
    EXPECT_EQ(same_results({row("a", 1, 50.0), row("a_d2", 1, 50.0)}, names), Groups{});
}

}  // namespace
}  // namespace breach::orchestrator::same_results_test
