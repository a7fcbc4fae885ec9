// Finds parameters of PM4Sand with undrained strengths that meet targets and a cyclic strength that
// stays that of a reference soil (automates the calibration of Sordo et al.) or meets measured
// curves. Deterministic.
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
    double strain;  ///< shear strain at which tau is read
    double s_u;     ///< wanted [Pa]
};

/// One point of a cyclic strength curve; wanted are the cycles that a laboratory counted, or those
/// that the reference soil needs.
struct CyclicTarget {
    double sigma_v;  ///< [Pa]
    double K0;
    double CSR;
    double strain;              ///< single amplitude that counts as failure
    std::optional<double> N{};  ///< measured
    double weight = 1.0;        ///< of its share in the misfit
};

/// A parameter to be varied; identified by its name in SandParameters.
struct FreeParameter {
    std::string name;
    double least, most;
};

struct CalibrationProblem {
    SandParameters start;
    std::optional<SandParameters> reference;  ///< for targets that were not measured
    std::vector<FreeParameter> free;
    std::vector<StrengthTarget> strength;
    std::vector<CyclicTarget> cyclic;
    double strength_spread = 0.05;  ///< relative deviation that counts as one
    double cyclic_spread = 0.05;    ///< the same, of the cyclic stress ratio
    materials::pm4sand::Options options;
    double monotonic_step = 2e-4;
    double cyclic_step = 1e-4;
    int most_evaluations = 800;
    int most_cycles = 300;
};

/// Names that FreeParameter may use.
std::vector<std::string> parameter_names();
double& parameter(SandParameters& parameters, const std::string& name);

/// One deviation: computed against wanted. For cyclic terms both are cycles to failure, and the
/// deviation is that of the stress ratio at the same number of cycles, read off the slope of the
/// wanted curve at this stress.
struct Term {
    std::string name;
    double wanted, computed;
    double deviation;  ///< relative
    double share;      ///< weight (deviation / spread)^2, its part of the misfit
};

struct Fit {
    std::vector<double> values;  ///< of the free parameters
    double misfit;               ///< sum of shares
    std::vector<Term> terms;
};

/// The problem with the wanted cycles and the slopes of their curves. Throws std::invalid_argument
/// where a target has neither cycles nor a reference soil.
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

/// Damped Gauss-Newton in the logarithms of the parameters, then Nelder and Mead's simplex around
/// its result. Calls `seen` after each evaluation (for progress); it may be empty.
CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<void(int, const Fit&)>& seen = {});

}  // namespace breach::element_bench
