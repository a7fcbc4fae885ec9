#include "tests/unit/mpm/memory.hpp"

#include <gtest/gtest.h>

namespace breach::mpm::test {
namespace {

/// The points' numbers are 168 of these; most of the rest are grid nodes, 1.8 per point.
TEST(Memory, OfARunIsAtMost359BytesPerPoint) {
    const double bytes = bytes_per_point(tall_column(0.2, 2));
    if (bytes < 1.0) GTEST_SKIP() << "a sanitizer's allocator does not count";
    std::printf("    %.1f bytes per point\n", bytes);
    EXPECT_GT(bytes, 168.0);
    EXPECT_LE(bytes, 359.0);
}

}  // namespace
}  // namespace breach::mpm::test
