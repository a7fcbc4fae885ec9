// The commands of the command line: each queries the server and prints the answer. watch, logs and
// export have their own files. Every command returns its exit code, or throws.
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

struct SubmitOptions {
    std::filesystem::path study;
    std::filesystem::path scene = {};  ///< instead of a study: it is put into a new study
    std::vector<std::string> overrides;
    std::string idempotency_key;              ///< empty: none
    std::vector<double> transfer_times = {};  ///< instead of the study's [s]; empty: the study's
    std::string route = "/v1/runs";           ///< or "/v1/sweeps"
    bool send_files = false;                  ///< even to a server on this machine
};

/// Prints the new run's id, and returns it.
std::string submit(Server& server, const SubmitOptions& options, const Console& console);

/// Prints the cost of the study and, for an uncertainty study, the number of its tasks. Submits
/// nothing, but reports the same faults as a submission.
fault::ExitCode show_plan(Server& server, const SubmitOptions& options, const Console& console);

struct Extension {
    std::string run;
    std::vector<double> times;  ///< more transfer times of a sweep [s]
    std::size_t samples = 0;    ///< an uncertainty study's samples in all; 0: not these
};

/// Prints what was added; what was computed stays.
fault::ExitCode extend(Server& server, const Extension& by, const Console& console);

fault::ExitCode list_runs(Server& server, std::size_t most, const Console& console);
/// `id`: of a run or of a task
fault::ExitCode show(Server& server, const std::string& id, const Console& console);
/// `word`: cancel, pause, resume or retry.
fault::ExitCode order(Server& server, const std::string& run, const std::string& word,
                      const Console& console);
fault::ExitCode rename(Server& server, const std::string& run, const std::string& title,
                       const Console& console);
fault::ExitCode set_priority(Server& server, const std::string& run, std::int64_t priority,
                             const Console& console);

/// Whether a questionable result makes the exit code a failure.
enum class Questionable { accepted, fails };

/// breakdown (70) when the ended run failed, was cancelled, or has a questionable result and
/// `questionable` is fails. Prints the reason to the notes.
fault::ExitCode code_of_end(const nlohmann::json& run, Questionable questionable,
                            const Console& console);

struct ResultsOptions {
    std::string run;
    std::string state;   ///< only rows in this state; empty: all
    std::string flag;    ///< only rows with a flag of this code; empty: all
    bool means = false;  ///< only the means over the repeats
    Questionable questionable = Questionable::accepted;
};

/// Returns code_of_end.
fault::ExitCode results(Server& server, const ResultsOptions& options, const Console& console);

/// The table of an accuracy study, its ladders and its recommendation. asked_error: instead of the
/// study's; empty: the study's.
fault::ExitCode show_accuracy(Server& server, const std::string& run,
                              const std::string& asked_error, const Console& console);

struct UncertaintyOptions {
    std::string run;
    std::string quantity;  ///< only statistics of this quantity; empty: of all
};
/// Results of an uncertainty study's samples, also while its run goes on; as CSV the samples.
fault::ExitCode show_uncertainty(Server& server, const UncertaintyOptions& options,
                                 const Console& console);

struct TelemetryOptions {
    std::string run;
    std::string phase;
    std::string transfer_time;  ///< empty: the phase has none
    std::string variant;        ///< empty: the phase serves all
    std::string fields;         ///< "a,b"; empty: all
    std::int64_t from = 0;
    std::int64_t stride = 1;
};

struct HydrographOptions {
    std::string run;
    std::string section;
    std::string target = "csv";  ///< json, csv, hec-ras, hec-ras-unsteady or flo-2d
    std::string transfer_time;   ///< empty: the run has one runout
    std::string variant;
    std::string breach_width;    ///< [m], "72" or "60,72,90"; empty: the scene's
    std::string interval;        ///< between two flows of an export [s]
    std::string cell;            ///< FLO-2D: grid element that takes the inflow
    std::string concentration;   ///< solids by volume
    std::string percentile;      ///< of the volume, over all runouts
    std::string rheology;        ///< HEC-RAS's non-Newtonian method
    std::string yield_stress;    ///< [Pa]
    std::string viscosity;       ///< [Pa s]
    std::filesystem::path file;  ///< empty: printed
};

/// The flow past a section of a runout, as rows or in another program's format.
fault::ExitCode hydrograph(Server& server, const HydrographOptions& options,
                           const Console& console);

/// The report of the run so far as a PDF, or as HTML where the file's name ends so. file: empty for
/// the run's name.
fault::ExitCode report(Server& server, const std::string& run, std::filesystem::path file,
                       const Console& console);

fault::ExitCode telemetry(Server& server, const TelemetryOptions& options, const Console& console);
/// document: a scene or a study.
fault::ExitCode plan(Server& server, const std::filesystem::path& document, const Console& console);

/// A run's id from the id itself, its beginning, a name (its newest run), or "latest" (the newest
/// run). Throws Refused when there is none, or when several ids begin with it.
std::string run_named(Server& server, const std::string& name);

}  // namespace breach::cli
