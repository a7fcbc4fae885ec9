// The tangents against differences of the stress update.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/verification/pm4sand/soils.hpp"

namespace breach::testing {
namespace {

using namespace pm4sand;
using mechanics::Matrix4;
using mechanics::Voigt;

/// A foundation point during loading.
State sheared(const Ready& law, double gamma) {
    State state = consolidated(law, 100.0, 0.5);
    for (int i = 0; i < 200; ++i) state = integrate(law, state, shear(gamma / 200.0), {}).state;
    return state;
}

TEST(Pm4SandTangent, ElasticOneIsSymmetricAndPositive) {
    const Ready law = ready(soil("tailings_def"));
    const Matrix4 C = elastic_tangent(law, sheared(law, 2e-3));
    EXPECT_TRUE(C.isApprox(C.transpose()));
    EXPECT_GT(C.determinant(), 0.0);
}

TEST(Pm4SandTangent, PlasticOneIsTheDerivativeAlongLoading) {
    for (const char* name : {"tailings_cal", "tailings_def", "foundation"}) {
        const Ready law = ready(soil(name));
        const State state = sheared(law, 3e-3);
        const Voigt d(1e-10, 2e-10, 0.0, 1e-8);
        // The plastic direction lags the strain direction; in undrained shear they are aligned.
        const Voigt change = stress(law, integrate(law, state, d, {}).state) - stress(law, state);
        const Voigt predicted = plastic_tangent(law, state, d) * d;
        for (const int i : {0, 1, 3}) {
            EXPECT_NEAR(predicted[i], change[i], 0.02 * change.norm()) << name << " " << i;
        }
    }
}

TEST(Pm4SandTangent, IsElasticWhenTheStrainTurnsRound) {
    const Ready law = ready(soil("tailings_def"));
    const State state = sheared(law, 3e-3);
    EXPECT_TRUE(plastic_tangent(law, state, shear(-1e-8)).isApprox(elastic_tangent(law, state)));
}

}  // namespace
}  // namespace breach::testing
