// Measures a run's values of a paper's quantities, by name.
#pragma once

#include <map>
#include <optional>

#include "services/report/read/paper.hpp"
#include "services/report/read/run_folder.hpp"
#include "services/report/read/telemetry.hpp"

namespace breach::report {

/// One number and its origin.
struct Measure {
    double value = 0.0;
    std::string source;        ///< label of the phase
    double cpu_seconds;        ///< of that phase; for a number from several runs, their sum
    std::string error = {};    ///< its error; empty: unknown
    bool lower_bound = false;  ///< soil still moved in one of its runs
    double least = value, most = value;  ///< of its runs
};
using Measures = std::map<std::string, Measure>;

/// The phase with a variant's results: its own, the one shared by all, or the only one. Of phases
/// shared by some variants: the one that its runouts or transfers came from, or the FEM without a
/// transfer. Null when none is known.
const PhaseFolder* phase_of_variant(const Run& run, const std::string& phase,
                                    const std::string& variant);
/// Telemetry of a FEM; conditions may use the critical depth of the run's stability analysis.
Telemetry telemetry_of(const Run& run, const PhaseFolder& fem);

/// The edges of the transfer window [s], from the study's first window trigger or /transfer/window
/// of the scene; an edge that the telemetry never meets is missing. There is no window if the mesh
/// was too distorted (upper) before the failure developed (lower).
struct WindowEdges {
    std::optional<double> lower, upper;

    bool is_none() const { return lower && upper && *upper <= *lower; }
};
WindowEdges window_of(const Run& run, const Telemetry& fem);
/// The same from measured values.
WindowEdges window_in(const Measures& measures);

/// A field of the telemetry and the number that a condition compares it with.
struct Threshold {
    std::string field;
    double value;
};
/// From the study's triggers, or /transfer/window of the scene.
std::vector<Threshold> thresholds_in(const Run& run);

/// Runs of the MPM that ended, of one variant, ascending in t_T.
std::vector<const PhaseFolder*> runouts_of(const Run& run, const std::string& variant);
double runout_of(const PhaseFolder* mpm);  ///< [m]
/// The governing one (services/findings/governing.hpp); null when the run has none.
const PhaseFolder* farthest_runout(const Run& run);
/// The stability analysis with the least factor of safety; null when none has one.
const PhaseFolder* least_factor(const Run& run);

/// Of several runs of a phase the one shown in detail: the source of the farthest runout, or the
/// first if that is unknown; null when there is none.
const PhaseFolder* phase_shown(const Run& run, const std::string& phase);
/// "Of 2 finite element analyses the one behind the farthest runout: loose. "; empty if there is
/// only one.
std::string which_of_several(const Run& run, const PhaseFolder& shown, const std::string& plural);
/// In the study's order, or by name where the folder has no study.
std::vector<std::string> variants_of(const Run& run);

/// The transfer times around the largest runout whose runouts are at least this share of it.
inline constexpr double plateau_share = 0.75;
struct Plateau {
    double first, last;                            ///< transfer times [s]
    std::vector<const PhaseFolder*> runouts = {};  ///< of the variant between them
};
/// Variants that share a FEM share the transfer times, taken from the one with the largest runout.
/// Nothing when none has a runout beyond the toe.
std::optional<Plateau> plateau_of(const Run& run, const std::string& variant);
double median(std::vector<double> values);

/// Keys are those of paper.json; quantities that the run lacks are missing. With a variant the key
/// ends in ":<variant>"; on a plateau the value is the median over its runouts. Quantities that
/// depend on a condition or a transfer time of the paper are measured for its scenes only.
Measures measures_of(const Run& run, const std::optional<Paper>& paper);

/// Paper beside run, one row per value of the paper; "-" where the run has no value.
Table comparison(const Paper& paper, const Measures& ours);

}  // namespace breach::report
