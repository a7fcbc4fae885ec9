#include "tests/verification/transfer/case_field.hpp"

#include <gtest/gtest.h>

namespace breach::transfer::case_field_test {
namespace {

// Limits: 0.15 and 0.6 kPa rms, 3 kPa at most.
TEST(CaseField, TheDefaultModeIsWithinTheLimitsOnGradedElements) {
    ASSERT_EQ(case_field::mesh().quads.size(), 5130u);
    const auto error = case_field::measured(meshes::settings(2));
    EXPECT_LT(error.inside, 0.15e3);
    EXPECT_LT(error.outside, 0.6e3);
    EXPECT_LT(error.largest, 3e3);
}

}  // namespace
}  // namespace breach::transfer::case_field_test
