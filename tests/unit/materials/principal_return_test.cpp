// The closed forms against an independent solver: Koiter's rule by trying every set of up to three
// of the nine planes.
#include "core/materials/mohr_coulomb/principal_return.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "tests/unit/materials/samples.hpp"

namespace breach::materials::principal_return_test {
namespace {

struct Plane {
    Triple normal;
    Triple flow;
    double offset;
};

std::vector<Plane> planes_of(const Cone& cone) {
    std::vector<Plane> planes;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (i == j) continue;
            planes.push_back({cone.k * Triple::Unit(i) - Triple::Unit(j),
                              cone.m * Triple::Unit(i) - Triple::Unit(j), cone.q});
        }
        if (std::isfinite(cone.T)) planes.push_back({Triple::Unit(i), Triple::Unit(i), cone.T});
    }
    return planes;
}

Matrix3 stiffness(const Moduli& moduli) {
    Matrix3 D = Matrix3::Constant(moduli.lambda);
    D.diagonal().array() += 2.0 * moduli.G;
    return D;
}

/// The returned stress for this set of planes, and its violation of Koiter's rule.
struct Attempt {
    Triple sigma;
    double violation;
};

std::optional<Attempt> attempt(const std::vector<Plane>& planes, const std::vector<int>& active,
                               const Matrix3& D, const Triple& trial) {
    const int n = static_cast<int>(active.size());
    Eigen::MatrixXd normals(3, n);
    Eigen::MatrixXd flows(3, n);
    Eigen::VectorXd excess(n);
    for (int a = 0; a < n; ++a) {
        normals.col(a) = planes[active[a]].normal;
        flows.col(a) = planes[active[a]].flow;
        excess[a] = planes[active[a]].normal.dot(trial) - planes[active[a]].offset;
    }
    const Eigen::MatrixXd system = normals.transpose() * D * flows;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(system);
    if (!lu.isInvertible() || !(lu.rcond() > 1e-11)) return std::nullopt;
    const Eigen::VectorXd multipliers = lu.solve(excess);
    Attempt result{trial - D * (flows * multipliers), -D(0, 0) * multipliers.minCoeff()};
    for (const Plane& plane : planes) {
        result.violation =
            std::max(result.violation, plane.normal.dot(result.sigma) - plane.offset);
    }
    return result;
}

Attempt by_enumeration(const Cone& cone, const Moduli& moduli, const Triple& trial) {
    const std::vector<Plane> planes = planes_of(cone);
    const Matrix3 D = stiffness(moduli);
    const int count = static_cast<int>(planes.size());
    Attempt best{trial, std::numeric_limits<double>::infinity()};
    const auto consider = [&](const std::vector<int>& active) {
        const auto next = attempt(planes, active, D, trial);
        if (next && next->violation < best.violation) best = *next;
    };
    for (int a = 0; a < count; ++a) {
        consider({a});
        for (int b = a + 1; b < count; ++b) {
            consider({a, b});
            for (int c = b + 1; c < count; ++c) consider({a, b, c});
        }
    }
    return best;
}

Triple sorted_trial(samples::Draw& draw, double size) {
    Triple trial = size * Triple(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1));
    if (draw.uniform(0, 1) < 0.2) trial.array() += size * draw.uniform(-2, 2);
    std::sort(trial.data(), trial.data() + 3, std::greater<>());
    return trial;
}

Cone cone_of(const MohrCoulomb& law) { return ready(law).peak; }

bool outside(const Cone& cone, const Triple& s) {
    return cone.k * s[0] - s[2] > cone.q || s[0] > cone.T;
}

TEST(PrincipalReturn, AgreesWithEnumerationOnEveryFacet) {
    samples::Draw draw(1);
    std::map<Facet, int> reached;
    double worst = 0.0;
    for (const MohrCoulomb& law : samples::soils()) {
        const Cone cone = cone_of(law);
        const Moduli moduli = make_moduli(law.elasticity);
        for (int n = 0; n < 150; ++n) {
            const double size = draw.magnitude(1e3, 1e7);
            const Triple trial = sorted_trial(draw, size);
            if (!outside(cone, trial)) continue;
            const PrincipalReturn mine = return_to_cone(cone, moduli, trial);
            const Attempt reference = by_enumeration(cone, moduli, trial);
            ++reached[mine.facet];
            // Relative to the largest stress. The enumeration solves systems with condition numbers
            // up to lambda / G = 5000 at nu = 0.4999: 1e-8 leaves three digits above its round-off.
            const double scale = trial.cwiseAbs().maxCoeff() + cone.q;
            const double error = (mine.sigma - reference.sigma).cwiseAbs().maxCoeff() / scale;
            worst = std::max(worst, error);
            ASSERT_LT(error, 1e-8)
                << "phi " << law.phi << " psi " << law.psi << " c " << law.c << " cut "
                << law.tension_cutoff << " nu " << law.elasticity.nu << "\ntrial "
                << trial.transpose() << "\nmine " << mine.sigma.transpose() << " facet "
                << static_cast<int>(mine.facet) << "\nenumerated " << reference.sigma.transpose()
                << " violation " << reference.violation;
        }
    }
    EXPECT_EQ(reached.size(), 9u) << "some facet was never reached";
    std::printf("worst difference %.2e of the stress, allowed 1e-8\n", worst);
}

TEST(PrincipalReturn, IsTheClosestPointInEnergyWhenFlowIsAssociated) {
    samples::Draw draw(2);
    for (const MohrCoulomb& law : samples::soils()) {
        if (law.psi != law.phi) continue;
        const Cone cone = cone_of(law);
        const Moduli moduli = make_moduli(law.elasticity);
        const Matrix3 compliance = stiffness(moduli).inverse();
        for (int n = 0; n < 20; ++n) {
            const double size = draw.magnitude(1e3, 1e6);
            const Triple trial = sorted_trial(draw, size);
            if (!outside(cone, trial)) continue;
            const PrincipalReturn mine = return_to_cone(cone, moduli, trial);
            const Triple removed = trial - mine.sigma;
            const double energy = removed.dot(compliance * removed);
            for (int other = 0; other < 200; ++other) {
                Triple s = mine.sigma + draw.magnitude(1e-4, 1.0) * sorted_trial(draw, size);
                std::sort(s.data(), s.data() + 3, std::greater<>());
                if (outside(cone, s)) continue;
                const Triple d = trial - s;
                ASSERT_GE(d.dot(compliance * d), energy * (1.0 - 1e-9));
            }
        }
    }
}

TEST(PrincipalReturn, CutOffAloneIsRankine) {
    const Cone cone = cone_of(samples::soil(30, 0, 1e6, 2e3));
    const Moduli moduli = make_moduli({2e7, 0.25});  // lambda = G = 8 MPa
    // One axis is extended by e: the other two follow by lambda / (lambda + 2 G) = 1/3 of the loss
    // of the first.
    const PrincipalReturn one = return_to_cone(cone, moduli, {8e3, 1e3, -4e3});
    EXPECT_EQ(one.facet, Facet::cut_plane);
    EXPECT_NEAR(one.sigma[0], 2e3, 1e-9);
    EXPECT_NEAR(one.sigma[1], -1e3, 1e-9);
    EXPECT_NEAR(one.sigma[2], -6e3, 1e-9);
    EXPECT_NEAR(one.d_epsilon_plastic[0], 6e3 / 2.4e7, 1e-15);
    // All three are extended.
    const PrincipalReturn all = return_to_cone(cone, moduli, {9e4, 9e4, 9e4});
    EXPECT_EQ(all.facet, Facet::tip);
    EXPECT_NEAR(all.d_epsilon_plastic.sum(), (9e4 - 2e3) / moduli.K, 1e-12);
}

}  // namespace
}  // namespace breach::materials::principal_return_test
