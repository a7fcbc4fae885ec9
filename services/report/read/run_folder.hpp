// A run on the disk: its phases, their files and results. Reads the folder of `breach export`,
// the run's folder below the service's data folder, or any folder that has one folder per
// phase.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace breach::report {

/// One phase of the run, in any state.
struct PhaseFolder {
    std::string phase;    ///< "lem_tool", "fem_solver", "transfer_tool", "mpm_solver"
    std::string label;    ///< name of the folder in the run: "mpm_13.000000_softened"
    std::string variant;  ///< empty: serves all variants
    std::optional<double> transfer_time;  ///< t_T [s]
    std::filesystem::path files;          ///< folder of its outputs
    nlohmann::json scene;                 ///< completed, with the overrides of this phase
    nlohmann::json result;                ///< result.json; null when it did not end well
    /// Of a runout: error of one run [m], and its source or why there is none
    std::optional<double> runout_error = {};
    std::string runout_error_from = {};
    std::string fault;                        ///< why there is no result; empty when there is one
    std::vector<std::string> artifacts = {};  ///< SHA-256 of its files, in an export
    std::string task = {};                    ///< its id in the service, in an export
};

struct Run {
    std::filesystem::path folder;
    std::string name;
    std::string title;
    std::string id;             ///< empty: not known to a service
    std::string state = {};     ///< of the run as the service reported it; empty: not known
    std::string finished = {};  ///< when; empty: not known, or it has not
    /// Completed: the study's, with its overrides and without its variants' changes; in a folder
    /// without a study that of its first phase
    nlohmann::json scene;
    nlohmann::json study;             ///< null when the folder has none
    std::vector<PhaseFolder> phases;  ///< by phase, then transfer time, then variant
    /// Over the repeats of each runout, from the service; empty: the study has no repeats, or the
    /// folder no results.json
    nlohmann::json means = nlohmann::json::array();
    /// Variants without a transfer, and why, from the service.
    nlohmann::json without_transfer = nlohmann::json::array();
    /// Variants all of whose transfer times lie after the end of their FEM: the first row of each.
    nlohmann::json not_reached = nlohmann::json::array();
    nlohmann::json same_results = nlohmann::json::array();  ///< groups of variants
    /// Of a study over distributions, from the service; null where the folder has none
    nlohmann::json uncertainty = {};
    nlohmann::json envelopes = {};
    nlohmann::json motions = {};  ///< of a study of several motions; null where the folder has none
};

/// A folder belongs to a phase when it contains scene.completed.json, or the task.json of an export, and its label begins with
/// lem, fem, transfer or mpm (or one of its files names the phase). A task that has not begun is a phase without a result; a
/// task not reached by its FEM is no phase. Throws IoError when the folder cannot be read, BadInput when it contains no phase
/// or a file in it is invalid.
Run read_run(const std::filesystem::path& folder);

std::vector<const PhaseFolder*> phases_named(const Run& run, const std::string& phase);
/// The runouts averaged in this row of the means.
std::vector<const PhaseFolder*> draws_of(const Run& run, const nlohmann::json& mean);
/// The first one, null when there is none. Of several FEMs (for variants) the first.
const PhaseFolder* phase_named(const Run& run, const std::string& phase);

/// The phase of the run that made this phase's input file: by the file's content, or by its folder;
/// null: none of the run did, or the result does not say.
const PhaseFolder* source_of(const Run& run, const PhaseFolder& phase);

/// Whether points fill the section: without a FEM there is no shaking and no transfer. Runouts with
/// a transfer time came from a FEM, also if its folder is missing.
bool is_static(const Run& run);
/// Whether some FEM of the run has a motion.
bool is_shaken(const Run& run);

/// False for a phase that ended before its first line.
bool has_telemetry(const PhaseFolder& phase);

/// A file with a time in its name: "snapshot_2.750000.vtkhdf".
struct TimedFile {
    double time;
    std::filesystem::path file;
};
/// Ascending in time.
std::vector<TimedFile> timed_files(const std::filesystem::path& folder, const std::string& prefix);

}  // namespace breach::report
