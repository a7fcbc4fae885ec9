#include <gtest/gtest.h>

#include "services/cli/export_run.hpp"
#include "services/cli/logs.hpp"

namespace breach::cli {

TEST(ExportedName, StaysBelowItsFolder) {
    EXPECT_EQ(path_below("/out", "tasks/fem/result.json"), "/out/tasks/fem/result.json");
    for (const char* wrong : {"", "/etc/passwd", "../x", "a/../../x", "a/..", "a//"})
        EXPECT_THROW(path_below("/out", wrong), fault::IoError) << wrong;
    EXPECT_THROW(path_below("/out", std::string("a\0b", 3)), fault::IoError);
}

TEST(LastLines, AreTheLast) {
    EXPECT_EQ(last_lines("a\nb\nc\n", 2), "b\nc\n");
    EXPECT_EQ(last_lines("a\nb\nc", 1), "c");
    EXPECT_EQ(last_lines("a\nb\n", 9), "a\nb\n");
    EXPECT_EQ(last_lines("a\nb\n", 0), "a\nb\n");
    EXPECT_EQ(last_lines("\n", 1), "\n");
    EXPECT_EQ(last_lines("", 3), "");
}

}  // namespace breach::cli
