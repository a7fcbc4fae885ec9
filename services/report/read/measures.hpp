// What a run says about the quantities that a paper gives, by name.
#pragma once

#include <map>
#include <optional>

#include "services/report/read/paper.hpp"
#include "services/report/read/run_folder.hpp"
#include "services/report/read/telemetry.hpp"

namespace breach::report {

/// One number with where it comes from.
struct Measure {
    double value = 0.0;
    std::string source;        ///< label of the phase
    double cpu_seconds;        ///< of that phase; of a number from several runs, their sum
    std::string error = {};    ///< what is known about its error
    bool lower_bound = false;  ///< soil still moved in a run behind it
    double least = value, most = value;  ///< of the runs behind it
};
using Measures = std::map<std::string, Measure>;

/// The phase whose results a variant uses: its own, the one that serves all, the only one, or of those
/// that serve some (called by the first of them) the one that its runouts or transfers came from, or
/// that nothing was transferred of; null when none is known.
const PhaseFolder* phase_of_variant(const Run& run, const std::string& phase,
                                    const std::string& variant);
/// Telemetry of a FEM; conditions may ask for the critical depth of the run's stability analysis.
Telemetry telemetry_of(const Run& run, const PhaseFolder& fem);

/// The edges of the transfer window [s] as the study's first window trigger finds them, or
/// /transfer/window of the scene; an edge that telemetry never meets is missing. A mesh that is too
/// distorted (upper) since before the failure is developed (lower) leaves no window.
struct WindowEdges {
    std::optional<double> lower, upper;

    bool is_none() const { return lower && upper && *upper <= *lower; }
};
WindowEdges window_of(const Run& run, const Telemetry& fem);
/// The same as it was measured.
WindowEdges window_in(const Measures& measures);

/// A field of the telemetry that a condition compares with one number.
struct Threshold {
    std::string field;
    double value;
};
/// Of the study's triggers, or of /transfer/window of the scene.
std::vector<Threshold> thresholds_in(const Run& run);

/// Runs of the MPM that ended, of one variant, ascending in t_T.
std::vector<const PhaseFolder*> runouts_of(const Run& run, const std::string& variant);
double runout_of(const PhaseFolder* mpm);  ///< of one of them [m]
/// The one that governs (services/findings/governing.hpp); null when the run has none.
const PhaseFolder* farthest_runout(const Run& run);
/// The stability analysis with the least factor of safety; null when none has one.
const PhaseFolder* least_factor(const Run& run);

/// Of several phases of a kind the one that is looked at closely: what the farthest runout came
/// from, or the first where there is no runout or that is not known; null when there is none.
const PhaseFolder* phase_shown(const Run& run, const std::string& phase);
/// "Of 2 finite element analyses the one behind the farthest runout: loose. "; empty where there is
/// one.
std::string which_of_several(const Run& run, const PhaseFolder& shown, const std::string& plural);
/// In the study's order, or by name where the folder has no study.
std::vector<std::string> variants_of(const Run& run);

/// The transfer times around the largest runout whose runouts are at least this share of it.
inline constexpr double plateau_share = 0.75;
struct Plateau {
    double first, last;                            ///< transfer times [s]
    std::vector<const PhaseFolder*> runouts = {};  ///< of the variant between them
};
/// Variants that share a FEM share the edges, which the one that runs farthest sets; nothing when
/// none has a runout beyond the toe.
std::optional<Plateau> plateau_of(const Run& run, const std::string& variant);
double median(std::vector<double> values);

/// Keys are those of paper.json; a quantity that the run does not hold is missing. With a variant
/// the key ends in ":<variant>"; that of a plateau is the median over its runouts. What depends on
/// a condition or a transfer time of the paper is measured for its scenes only.
Measures measures_of(const Run& run, const std::optional<Paper>& paper);

/// Paper beside ours, one row per value of the paper; "-" where the run does not hold it.
Table comparison(const Paper& paper, const Measures& ours);

}  // namespace breach::report
