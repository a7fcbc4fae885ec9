#include <gtest/gtest.h>

#include <map>

#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"
#include "tests/unit/materials/samples.hpp"

namespace breach::materials::tangent_test {
namespace {

Matrix4 by_differences(const MohrCoulombNumbers& law, const State& old, const Voigt& d_epsilon,
                       double step) {
    Matrix4 tangent;
    for (int j = 0; j < 4; ++j) {
        const Voigt h = step * Voigt::Unit(j);
        tangent.col(j) = (integrate(law, old, d_epsilon + h).state.sigma -
                          integrate(law, old, d_epsilon - h).state.sigma) /
                         (2.0 * step);
    }
    return tangent;
}

/// True if no perturbation of the step reaches another facet, which would mix two tangents in the
/// differences.
bool same_facet_around(const MohrCoulombNumbers& law, const State& old, const Voigt& d_epsilon,
                       double step) {
    const auto facet_at = [&](const Voigt& e) {
        const Voigt trial = trial_stress(law.moduli, old.sigma, e);
        if (lies_inside(law.peak, trial)) return -1;
        const double centre = 0.5 * (trial[0] + trial[1]);
        const double radius = std::hypot(0.5 * (trial[0] - trial[1]), trial[3]);
        Triple sorted(centre + radius, centre - radius, trial[2]);
        const int rank = trial[2] > sorted[0] ? 0 : trial[2] < sorted[1] ? 2 : 1;
        std::sort(sorted.data(), sorted.data() + 3, std::greater<>());
        return 3 * static_cast<int>(return_to_cone(law.peak, law.moduli, sorted).facet) + rank;
    };
    const int here = facet_at(d_epsilon);
    for (int j = 0; j < 4; ++j) {
        for (const double sign : {-3.0, 3.0}) {
            if (facet_at(d_epsilon + sign * step * Voigt::Unit(j)) != here) return false;
        }
    }
    return true;
}

TEST(ConsistentTangent, AgreesWithFiniteDifferencesOnEveryFacet) {
    samples::Draw draw(20);
    std::map<Return, int> reached;
    double worst = 0.0;
    for (const MohrCoulomb& law : samples::soils()) {
        const MohrCoulombNumbers prepared = ready(law);
        const double stiffest = law.elasticity.constrained_modulus();
        for (int n = 0; n < 200; ++n) {
            const State old = integrate(prepared, State{Voigt::Zero()}, draw.strain(1e-3)).state;
            const Voigt d_epsilon = draw.strain(1e-2);
            const double step = 1e-5 * d_epsilon.norm();
            if (!same_facet_around(prepared, old, d_epsilon, step)) continue;
            Matrix4 tangent;
            const Update update = integrate(prepared, old, d_epsilon, tangent);
            ++reached[update.kind];
            const Matrix4 differences = by_differences(prepared, old, d_epsilon, step);
            // Central differences: h^2 curvature (1e-10 relative, more where two axes are close)
            // and round-off 1e-16 / 1e-5 times the confinement; 1e-5 of the stiffest entry is far
            // below a wrong term.
            const double error = (tangent - differences).cwiseAbs().maxCoeff() / stiffest;
            worst = std::max(worst, error);
            ASSERT_LT(error, 1e-5)
                << "kind " << static_cast<int>(update.kind) << " phi " << law.phi << " psi "
                << law.psi << " c " << law.c << " cut " << law.tension_cutoff << " nu "
                << law.elasticity.nu << " d_epsilon " << d_epsilon.transpose() << " old "
                << old.sigma.transpose() << "\n"
                << tangent << "\n\n"
                << differences;
        }
    }
    EXPECT_EQ(reached.size(), 6u);
    std::printf("worst difference %.2e of the stiffest entry, allowed 1e-5\n", worst);
}

TEST(ConsistentTangent, IsSymmetricWhenFlowIsAssociated) {
    samples::Draw draw(21);
    for (const MohrCoulomb& law : samples::soils()) {
        if (law.psi != law.phi) continue;
        for (int n = 0; n < 100; ++n) {
            Matrix4 tangent;
            integrate(law, State{Voigt::Zero()}, draw.strain(1e-2), tangent);
            ASSERT_LT((tangent - tangent.transpose()).cwiseAbs().maxCoeff(),
                      1e-12 * law.elasticity.constrained_modulus());
        }
    }
}

TEST(ConsistentTangent, CoalescedAxesHaveTheLimitOfSeparateOnes) {
    for (const MohrCoulomb& law : samples::soils()) {
        for (const Voigt& equal : {Voigt(1e-3, 1e-3, -4e-3, 0), Voigt(-4e-3, -4e-3, 1e-3, 0),
                                   Voigt(3e-3, 3e-3, 1e-3, 0), Voigt(2e-3, 2e-3, 2e-3, 0)}) {
            Matrix4 limit;
            Matrix4 close;
            const State old{Voigt::Zero()};
            const Voigt apart = equal + Voigt(0, 0, 0, 1e-9);
            if (integrate(law, old, equal, limit).kind != integrate(law, old, apart, close).kind) {
                continue;
            }
            ASSERT_TRUE(limit.allFinite());
            // the two trials differ by 1e-6 of the strain
            ASSERT_LT((limit - close).cwiseAbs().maxCoeff(),
                      1e-5 * law.elasticity.constrained_modulus())
                << "phi " << law.phi << " c " << law.c << " cut " << law.tension_cutoff << " at "
                << equal.transpose() << "\n"
                << limit << "\n\n"
                << close;
        }
    }
}

TEST(ConsistentTangent, StaysFiniteForHugeSteps) {
    samples::Draw draw(22);
    for (const MohrCoulomb& law : samples::soils()) {
        for (int n = 0; n < 100; ++n) {
            Matrix4 tangent;
            integrate(law, State{Voigt::Zero()}, 1e2 * draw.voigt(1.0), tangent);
            ASSERT_TRUE(tangent.allFinite());
        }
    }
}

}  // namespace
}  // namespace breach::materials::tangent_test
