// Calibrates NorSand parameters from triaxial compression tests: critical state line from their
// ends; M_tc, N and chi_tc from their peaks; hardening from their curves. Such readings are biased
// (tests stop before the critical state, D_min is not exactly chi_i psi_i). The bias is measured on
// curves of the law, read in the same way, and corrected (indirect inference: Gourieroux, Monfort &
// Renault 1993).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/flag.hpp"
#include "element_bench/triaxial.hpp"

namespace breach::element_bench {

/// Indices of the calibrated parameters.
namespace sought {
enum Name { Gamma, lambda, M_tc, N, chi_tc, H_0, H_psi };
inline constexpr std::array names{"Gamma", "lambda", "M_tc", "N", "chi_tc", "H_0", "H_psi"};
}  // namespace sought
template <class T>
using OfEach = std::array<T, sought::names.size()>;

struct NorSandProblem {
    materials::norsand::Parameters law;  ///< elasticity, S of undrained tests, flow, p_min
    materials::norsand::Options options;
    OfEach<std::optional<double>> given{};  ///< given values, not calibrated
    std::vector<TriaxialTest> tests;
};

/// assumed: a usual value, neither given nor determined by the tests.
enum class Origin { fitted, given, assumed };
constexpr auto words_of(Origin) {
    using enum Origin;
    return words::in_order<Origin>({{fitted, "fitted"}, {given, "given"}, {assumed, "assumed"}});
}

struct Estimate {
    double value;
    std::optional<double> error;  ///< standard error; none: too few tests
    Origin origin;
    std::vector<std::size_t> tests;  ///< tests that determine it
};

struct TestFit {
    TriaxialReading measured;
    std::optional<TriaxialReading> read_back;  ///< reading of the law's curve
    std::optional<TriaxialCurve> curve;        ///< of the law, at the measured strains
    double psi_0;                              ///< of the test, relative to the fitted line
    std::optional<double> psi_peak;
    double q_misfit = 1.0;       ///< rms over the largest q
    double volume_misfit = 1.0;  ///< rms of epsilon_v (drained) or p / p_0 (undrained)
};

struct NorSandFit {
    materials::norsand::Parameters law;
    OfEach<Estimate> estimates;
    std::vector<TestFit> tests;  ///< in the order of the problem
    int rounds;
    std::vector<fault::Flag> flags;
};

/// Calls `seen` after each round with the largest change, if not empty.
NorSandFit calibrate(const NorSandProblem& problem,
                     const std::function<void(int, double)>& seen = {});

}  // namespace breach::element_bench
