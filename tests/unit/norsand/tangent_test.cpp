// The continuum tangent against differences of the integrated stress.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/norsand/soils.hpp"

namespace breach::testing {
namespace {

using namespace norsand;
using mechanics::Matrix4;
using mechanics::Voigt;

const Options fine{.tolerance = 1e-10, .most_evaluations = 100000};

/// A state reached by strain of all four components.
State travelled(const Ready& law, double psi_0) {
    const Voigt sigma(-70e3, -120e3, -80e3, 10e3);
    State state = initialise(law, sigma, psi_0 + critical_void_ratio(law, 90e3)).state;
    for (int i = 0; i < 20; ++i) {
        const Voigt d(5e-5, -1e-4, 0.0, 2e-4);
        state = integrate(law, state, d, fine).state;
    }
    return state;
}

TEST(NorSandTangent, IsTheDerivativeOfTheStressWhileLoadingGoesOn) {
    for (const char* name : {"CJ1", "CJ2", "NK", "TC"}) {
        for (const FlowRule rule : {FlowRule::js, FlowRule::radial, FlowRule::normal}) {
            for (const double psi_0 : {-0.05, 0.04}) {
                for (const double S : {0.0, 1.0}) {
                    Parameters parameters = soil(name);
                    parameters.flow = rule;
                    parameters.S = S;
                    const Ready law = ready(parameters);
                    const State state = travelled(law, psi_0);
                    const Voigt forward = 1e-7 * Voigt(0.3, -1.0, 0.0, 1.5);
                    const Matrix4 tangent = plastic_tangent(law, state, forward);
                    ASSERT_GT((tangent - elastic_tangent(law, state)).norm(), 1e3);
                    const Voigt base = stress(integrate(law, state, forward, fine).state);
                    // Around a loading increment, so that every difference still loads.
                    for (int column = 0; column < 4; ++column) {
                        Voigt up = forward, down = forward;
                        up[column] += 2e-9;
                        down[column] -= 2e-9;
                        const Voigt difference = (stress(integrate(law, state, up, fine).state) -
                                                  stress(integrate(law, state, down, fine).state)) /
                                                 4e-9;
                        EXPECT_LT((difference - tangent.col(column)).norm() / tangent.norm(), 2e-4)
                            << name << " column " << column << " S " << S;
                    }
                    EXPECT_LT((base - stress(state) - tangent * forward).norm(),
                              1e-3 * (tangent * forward).norm());
                }
            }
        }
    }
}

TEST(NorSandTangent, IsElasticWhereTheSoilUnloads) {
    const Ready law = ready(soil("CJ2"));
    const State state = travelled(law, 0.04);
    const Voigt back = -1e-7 * Voigt(0.3, -1.0, 0.0, 1.5);
    EXPECT_EQ(plastic_tangent(law, state, back), elastic_tangent(law, state));
    const Voigt answer = stress(integrate(law, state, back, fine).state) - stress(state);
    const Voigt expected = elastic_tangent(law, state) * back;
    EXPECT_LT((answer - expected).norm() / expected.norm(), 1e-4);
}

}  // namespace
}  // namespace breach::testing
