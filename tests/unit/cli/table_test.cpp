#include "services/cli/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace breach::cli {

TEST(Table, ColumnsAreAsWideAsTheirWidestCell) {
    EXPECT_EQ(
        as_table({{"name"}, {"x", right}, {""}}, {{"a", "1.5", ""}, {"longer", "10", "note"}}),
        "name      x\n"
        "a       1.5\n"
        "longer   10  note\n");
}

TEST(Table, CountsCharactersNotBytes) {
    EXPECT_EQ(as_table({{"a", right}}, {{"\xC3\xA9"}, {"xx"}}), " a\n \xC3\xA9\nxx\n");
}

TEST(Cell, ShowsFourDigitsAndADashForNothing) {
    EXPECT_EQ(cell(nlohmann::json(12.34567)), "12.35");
    EXPECT_EQ(cell(nlohmann::json(1234567)), "1234567");
    EXPECT_EQ(cell(nlohmann::json(12345.67)), "12346");
    EXPECT_EQ(cell(nlohmann::json()), "-");
    EXPECT_EQ(cell(nlohmann::json::object(), "absent"), "-");
}

TEST(Cell, DistinguishesNearTransferTimes) {
    const nlohmann::json row{{"late", 100.05}, {"later", 100.08}, {"whole", 3}};
    EXPECT_EQ(whole_cell(row, "late"), "100.05");
    EXPECT_EQ(whole_cell(row, "later"), "100.08");
    EXPECT_EQ(whole_cell(row, "whole"), "3");
    EXPECT_EQ(whole_cell(row, "absent"), "-");
}

TEST(Cell, CannotMoveTheCursor) { EXPECT_EQ(harmless("a\033[2Jb\nc\x7F"), "a [2Jb c "); }

TEST(Bar, StaysInItsFrame) {
    EXPECT_EQ(bar(0.25), "[#####...............]  25 %");
    EXPECT_EQ(bar(7.0), "[####################] 100 %");
    EXPECT_EQ(bar(-1.0), "[....................]   0 %");
    EXPECT_EQ(bar(std::nan("")), "[....................]   0 %");
    EXPECT_EQ(bar(0.9999), "[###################.]  99 %") << "100 % is only for what is done";
}

TEST(Shortened, DoesNotCutACharacter) {
    EXPECT_EQ(shortened("a\xC3\xA9z", 2), "a\xC3\xA9");
    EXPECT_EQ(shortened("abc", 5), "abc");
}

}  // namespace breach::cli
