// Prints the result and the limit of a verification.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace breach::mpm::test {

inline void expect_error_within(const std::string& what, double reached, double allowed) {
    std::printf("    %-58s reached %11.4e   allowed %9.2e\n", what.c_str(), reached, allowed);
    EXPECT_LE(std::abs(reached), allowed) << what;
}

}  // namespace breach::mpm::test
