#include "tests/unit/mpm/memory.hpp"

#include <gtest/gtest.h>

namespace breach::mpm::test {
namespace {

/// Of which the points' own numbers are 168; nodes of the grid, 1.8 per point, are most of the rest.
TEST(Memory, OfARunIsAtMost359BytesPerPoint) {
    const double bytes = bytes_per_point(tall_column(0.2, 2));
    if (bytes < 1.0) GTEST_SKIP() << "a sanitizer's allocator does not count";
    std::printf("    %.1f bytes per point\n", bytes);
    EXPECT_GT(bytes, 168.0);
    EXPECT_LE(bytes, 359.0);
}

}  // namespace
}  // namespace breach::mpm::test
