// Parameters of NorSand from triaxial compression tests: the critical state line from their ends, M_tc, N
// and chi_tc from their peaks, the hardening from their curves. Such readings are biased (a test stops
// short of its critical state, D_min is not quite chi_i psi_i). The bias is measured on the law's own
// curves, read in the same way, and corrected (indirect inference: Gourieroux, Monfort & Renault 1993).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/flag.hpp"
#include "element_bench/triaxial.hpp"

namespace breach::element_bench {

/// Indices of the calibrated parameters; in a namespace of their own because of the short names.
namespace sought {
enum Name { Gamma, lambda, M_tc, N, chi_tc, H_0, H_psi };
inline constexpr std::array names{"Gamma", "lambda", "M_tc", "N", "chi_tc", "H_0", "H_psi"};
}  // namespace sought
template <class T>
using OfEach = std::array<T, sought::names.size()>;

struct NorSandProblem {
    materials::norsand::Parameters law;  ///< elasticity, S of undrained tests, flow, p_min
    materials::norsand::Options options;
    OfEach<std::optional<double>> given{};  ///< given, so not calibrated
    std::vector<TriaxialTest> tests;
};

/// assumed: neither given nor determined by the tests, a usual value.
enum class Origin { fitted, given, assumed };
constexpr auto words_of(Origin) {
    using enum Origin;
    return words::in_order<Origin>({{fitted, "fitted"}, {given, "given"}, {assumed, "assumed"}});
}

struct Estimate {
    double value;
    std::optional<double> error;  ///< standard error; nothing: too few tests
    Origin origin;
    std::vector<std::size_t> tests;  ///< tests that determine it
};

struct TestFit {
    TriaxialReading measured;
    std::optional<TriaxialReading> read_back;  ///< of the law's curve
    std::optional<TriaxialCurve> curve;        ///< the law's, at the measured strains
    double psi_0;                              ///< of the test under the fitted line
    std::optional<double> psi_peak;
    double q_misfit = 1.0;       ///< rms over the largest q
    double volume_misfit = 1.0;  ///< rms of epsilon_v (drained), of p over p_0 (undrained)
};

struct NorSandFit {
    materials::norsand::Parameters law;
    OfEach<Estimate> estimates;
    std::vector<TestFit> tests;  ///< in the problem's order
    int rounds;
    std::vector<fault::Flag> flags;
};

/// Calls `seen` after each round with the largest change; it may be empty.
NorSandFit calibrate(const NorSandProblem& problem,
                     const std::function<void(int, double)>& seen = {});

}  // namespace breach::element_bench
