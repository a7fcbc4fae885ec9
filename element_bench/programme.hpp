// Test programmes on one specimen: monotonic shearing, stress or strain cycles, cyclic strength
// (CRR curves), modulus reduction and damping. Pure functions from a specimen to a record.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "element_bench/specimen.hpp"

namespace breach::element_bench {

/// One recorded state. Stresses [Pa], compression positive except tau.
struct Reading {
    double strain;    ///< the driven strain: gamma, or epsilon_yy
    double response;  ///< tau, or half the stress difference
    double sigma_xx, sigma_yy, sigma_zz, tau;
    double epsilon_v;  ///< compression positive
    double r_u;        ///< 1 - sigma_yy / (initial sigma_yy): excess pore pressure ratio
    double cycles;     ///< cycle count, 0 in monotonic tests
    std::optional<materials::norsand::State> norsand;  ///< state of a NorSand point
};

struct Record {
    std::vector<Reading> readings;
    double peak = 0.0;         ///< largest response; in monotonic tests also between calls [Pa]
    double peak_strain = 0.0;  ///< driven strain at the peak
    Specimen last;
    Ending outcome = Ending::done;
    long calls = 0;
    Counts counts;
};

/// Strain increment and number of readings.
struct Pace {
    double step;    ///< strain per call
    int every = 1;  ///< calls between readings; 0: first and last only
};

/// Drives the strain to `target` in equal steps.
Record monotonic(const Specimen& start, Boundary boundary, double target, const Pace& pace);

/// Limits that end a cyclic test.
struct Limit {
    double strain = 0.03;  ///< single amplitude of the driven strain
    double r_u = 2.0;      ///< excess pore pressure ratio; above 1: no limit
    int cycles = 200;
};

/// A cyclic test that reverses at the stresses mean +- amplitude [Pa].
struct CyclicStress {
    double amplitude;
    std::optional<double> mean{};  ///< none: the initial response
};

struct CyclicResult {
    Record record;
    double N_strain = -1.0;     ///< cycles to the strain limit, -1: not reached
    double N_1_percent = -1.0;  ///< cycles to 1 % strain
    double N_r_u = -1.0;        ///< cycles to r_u = 0.95
    double largest_r_u = 0.0;
};

/// Stress-reversed cycles. N counts as for a sine of unit period and never decreases: if the
/// specimen flows and cannot reach the amplitude, N stays at the phase of its last peak. Reversals
/// are at the target within 1e-9 of the amplitude.
CyclicResult cyclic_stress(const Specimen& start, Boundary boundary, const CyclicStress& load,
                           const Limit& limit, const Pace& pace);

/// Strain-reversed cycles between +-amplitude.
Record cyclic_strain(const Specimen& start, Boundary boundary, double amplitude, int cycles,
                     const Pace& pace);

struct Loop {
    double amplitude;  ///< strain
    /// [Pa]; none if the specimen failed before the loop's end
    std::optional<double> G_secant;
    /// energy lost / (4 pi energy stored) [-]; none also without stored energy
    std::optional<double> damping;
};

/// Secant modulus and damping of the last of `cycles` strain cycles, with `steps` calls per
/// quarter.
Loop hysteresis(const Specimen& start, Boundary boundary, double amplitude, int cycles, int steps);

}  // namespace breach::element_bench
