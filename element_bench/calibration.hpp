// Calibrates PM4Sand parameters: undrained strengths meet targets, and the cyclic strength stays
// that of a reference soil (as Sordo et al. did by hand) or meets measured curves. Deterministic.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "element_bench/programme.hpp"

namespace breach::element_bench {

using SandParameters = materials::pm4sand::Parameters;

/// Undrained strength in simple shear at a strain.
struct StrengthTarget {
    double sigma_v;  ///< [Pa]
    double K0;
    double strain;  ///< shear strain of this strength
    double s_u;     ///< target [Pa]
};

/// One point of a cyclic strength curve. The target are the measured cycles, or those of the
/// reference soil.
struct CyclicTarget {
    double sigma_v;  ///< [Pa]
    double K0;
    double CSR;
    double strain;              ///< single amplitude at failure
    std::optional<double> N{};  ///< measured
    double weight = 1.0;        ///< in the misfit
};

/// A parameter to calibrate, by its name in SandParameters.
struct FreeParameter {
    std::string name;
    double least, most;
};

struct CalibrationProblem {
    SandParameters start;
    std::optional<SandParameters> reference;  ///< for targets without measurement
    std::vector<FreeParameter> free;
    std::vector<StrengthTarget> strength;
    std::vector<CyclicTarget> cyclic;
    double strength_spread = 0.05;  ///< relative deviation with misfit 1
    double cyclic_spread = 0.05;    ///< the same for the cyclic stress ratio
    materials::pm4sand::Options options;
    double monotonic_step = 2e-4;
    double cyclic_step = 1e-4;
    int most_evaluations = 800;
    int most_cycles = 300;
};

/// Names that FreeParameter may use.
std::vector<std::string> parameter_names();
double& parameter(SandParameters& parameters, const std::string& name);

/// One deviation, computed minus target. Cyclic terms: cycles to failure, converted to a deviation
/// of the stress ratio at equal cycles by the slope of the target curve.
struct Term {
    std::string name;
    double wanted, computed;
    double deviation;  ///< relative
    double share;      ///< weight (deviation / spread)^2
};

struct Fit {
    std::vector<double> values;  ///< of the free parameters
    double misfit;               ///< sum of shares
    std::vector<Term> terms;
};

/// The problem with target cycles and slopes of their curves. Throws std::invalid_argument for a
/// target with neither cycles nor reference soil.
class Calibration {
  public:
    explicit Calibration(CalibrationProblem problem);

    Fit evaluate(const std::vector<double>& values) const;
    std::vector<double> start() const;
    SandParameters with(const std::vector<double>& values) const;
    const CalibrationProblem& problem() const { return problem_; }

  private:
    std::vector<Term> strength_terms(const SandParameters& parameters) const;
    std::vector<Term> cyclic_terms(const SandParameters& parameters) const;
    double cycles(const SandParameters& parameters, const CyclicTarget& target) const;

    CalibrationProblem problem_;
    std::vector<double> N_wanted_;
    std::vector<double> slope_;  ///< d ln CSR / d ln N, one per cyclic target
};

struct CalibrationResult {
    Fit first, best;
    std::vector<Fit> path;  ///< every improvement, without terms
    int evaluations;
    SandParameters parameters;
};

/// Samples the box of the bounds in logarithms, then Nelder-Mead from the best samples and around
/// the best result.
/// Calls `seen` after each evaluation, if not empty.
CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<void(int, const Fit&)>& seen = {});

}  // namespace breach::element_bench
