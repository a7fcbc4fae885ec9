// What a run says about the quantities that a paper gives, by name.
#pragma once

#include <map>
#include <optional>

#include "services/report/paper.hpp"
#include "services/report/run_folder.hpp"
#include "services/report/telemetry.hpp"

namespace breach::report {

/// One number with where it comes from.
struct Measure {
    double value;
    std::string source;      ///< label of the phase
    double cpu_seconds;      ///< of that phase; of a number from several runs, their sum
    std::string error = {};  ///< what is known about its error
};
using Measures = std::map<std::string, Measure>;

/// The edges of the transfer window [s] by the study's first window trigger, or /transfer/window of
/// the scene; an edge that telemetry never meets is missing.
struct WindowEdges {
    std::optional<double> lower, upper;
};
WindowEdges window_of(const Run& run, const Telemetry& fem);

/// Runs of the MPM that ended, of one variant, ascending in t_T.
std::vector<const PhaseFolder*> runouts_of(const Run& run, const std::string& variant);
std::vector<std::string> variants_of(const Run& run);

/// Keys are those of paper.json; a quantity that the run does not hold is missing. With a variant
/// the key ends in ":<variant>"; a plateau is the median over the transfer times in the window.
Measures measures_of(const Run& run);

/// Paper beside ours, one row per value of the paper; "-" where the run does not hold it.
Table comparison(const Paper& paper, const Measures& ours);

}  // namespace breach::report
