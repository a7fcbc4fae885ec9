// Inside the calibration of NorSand only: H_0 and H_psi by least squares between the measured and
// the law's curves, with all other values held. The hardening is sought as ln H at one or two state
// parameters (nodes), where the tests begin: H_0 and H_psi by themselves are nearly collinear.
#pragma once

#include "element_bench/norsand_readings.hpp"

namespace breach::element_bench {

/// The law's curves for these tests; none where it has no curve.
std::vector<std::optional<TriaxialCurve>> curves(const NorSandProblem& problem,
                                                 const Values& values, const Indices& which);

/// Deviations of a test's curves. Rows are weighted by the root of their strain increment, as the
/// density of readings varies along the curve.
struct Deviation {
    Eigen::VectorXd q;       ///< over the largest q
    Eigen::VectorXd volume;  ///< epsilon_v if drained, p / p_0 if undrained
};
Deviation deviation_of(const TriaxialTest& test, const TriaxialCurve& curve);

class Hardening {
  public:
    /// Chooses tests and nodes by the state parameters of these values.
    Hardening(const NorSandProblem& problem, const Values& values);

    /// Damped Gauss-Newton; from_afar: starts at the best of some constant H.
    Values fitted(const Values& values, bool from_afar) const;
    /// Fills tests, origin and error of H_0 and H_psi; `errors`: of the other values.
    void estimate(const Values& values, const std::vector<Values>& errors,
                  OfEach<Estimate>& out) const;

  private:
    bool is_given(sought::Name k) const { return problem_.given[k].has_value(); }
    Eigen::VectorXd nodes(const Values& values) const;
    Values with_nodes(const Values& values, const Eigen::VectorXd& ln_H) const;
    std::vector<Eigen::VectorXd> deviations(const Values& values) const;

    const NorSandProblem& problem_;
    Indices tests_;
    /// State parameters at which H is fitted: none if H is not calibrated or determined; one; or
    /// the smallest and the largest.
    std::vector<double> node_psi_;
};

}  // namespace breach::element_bench
