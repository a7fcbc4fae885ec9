// Reads a run from the disk: its phases, their files and results. Accepts the folder of `breach
// export`, the run's folder in the service's data folder, or any folder with one folder per phase.
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
    nlohmann::json result;                ///< result.json; null when the phase did not succeed
    /// Error of one runout [m], and its source or why there is none
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
    std::string id;          ///< empty: not known to a service
    std::string state = {};  ///< as the service reported it; empty: unknown
    nlohmann::json warnings = nlohmann::json::array();  ///< flags of the submission
    std::string finished = {};  ///< when the run ended; empty: unknown, or it has not
    /// Completed: the study's scene with its overrides, without the changes of variants; in a
    /// folder without a study, the scene of its first phase
    nlohmann::json scene;
    nlohmann::json study;             ///< null when the folder has none
    std::vector<PhaseFolder> phases;  ///< by phase, then transfer time, then variant
    /// Means over repeats, from the service; empty: the study has no repeats, or the folder no
    /// results.json
    nlohmann::json means = nlohmann::json::array();
    /// Variants without a transfer, and why, from the service.
    nlohmann::json without_transfer = nlohmann::json::array();
    /// Variants whose transfer times all lie after the end of their FEM: the first row of each.
    nlohmann::json not_reached = nlohmann::json::array();
    nlohmann::json same_results = nlohmann::json::array();  ///< groups of variants
    /// Of a study over distributions, from the service; null: not in the folder
    nlohmann::json uncertainty = {};
    nlohmann::json envelopes = {};
    nlohmann::json motions = {};  ///< of a study of several motions; null: not in the folder
};

/// A folder is a phase when it contains scene.completed.json, or the task.json of an export, and
/// its label begins with lem, fem, transfer or mpm (or one of its files names the phase). A task
/// that has not begun is a phase without a result. A task that its FEM did not reach is not a
/// phase. Throws IoError when the folder cannot be read, BadInput when it contains no phase or an
/// invalid file.
Run read_run(const std::filesystem::path& folder);

std::vector<const PhaseFolder*> phases_named(const Run& run, const std::string& phase);
/// The runouts averaged in this row of the means.
std::vector<const PhaseFolder*> draws_of(const Run& run, const nlohmann::json& mean);
/// The first one; null when there is none.
const PhaseFolder* phase_named(const Run& run, const std::string& phase);

/// The phase that made this phase's input file, found by the file's content or folder; null: none
/// of the run, or not recorded.
const PhaseFolder* source_of(const Run& run, const PhaseFolder& phase);

/// Whether points fill the section: the run has no FEM, so no shaking and no transfer. A runout
/// with a transfer time came from a FEM, even if its folder is missing.
bool is_static(const Run& run);
/// Whether some FEM of the run has a motion.
bool is_shaken(const Run& run);

/// False for a phase that ended before its first line of telemetry.
bool has_telemetry(const PhaseFolder& phase);

/// A file with a time in its name: "snapshot_2.750000.vtkhdf".
struct TimedFile {
    double time;
    std::filesystem::path file;
};
/// Ascending in time.
std::vector<TimedFile> timed_files(const std::filesystem::path& folder, const std::string& prefix);

}  // namespace breach::report
