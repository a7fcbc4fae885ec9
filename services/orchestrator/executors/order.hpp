// Messages between the service and an attempt's supervisor: the order (before) and the exit record
// (after). Both are files in the attempt's folder, so that neither side needs the other to be
// alive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/files/data_folder.hpp"

namespace breach::orchestrator {

/// Written by the executor before the supervisor starts, read by the supervisor, and after a
/// restart by the Slurm executor.
struct Order {
    /// Attempt id; every process started for it carries it in its environment
    std::string attempt;
    std::filesystem::path program;
    std::vector<std::string> arguments;  ///< without the program
    double grace_seconds;                ///< between TERM and KILL
    std::int64_t cores = 1;
    std::int64_t memory_mb = 0;  ///< 0: none requested
    std::int64_t priority = 0;   ///< higher goes first
};

/// Why an attempt must end. revoked: it was abandoned, and a later attempt may run already. signal:
/// not the service but another party stopped it, such as Slurm at a time limit or a machine that
/// shuts down.
enum class StopReason { cancel, shutdown, revoked, signal };
std::string_view name_of(StopReason reason);

/// Written once, by the supervisor, when no process of the attempt is left; its presence ends the
/// attempt.
struct ExitRecord {
    std::string attempt;
    std::optional<int> exit_code;
    std::optional<int> signal;
    std::optional<StopReason> stopped;
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;
    std::string disk = {};  ///< why files could not be written at the end; empty: they could
};

/// A supervisor's report about its phase while it runs, every two seconds. Read for life by the
/// Slurm executor, and for the cost of a lost attempt.
struct Heartbeat {
    std::string host;
    std::int64_t pid = 0;        ///< of the phase; 0: it has not begun
    double cpu_seconds = 0.0;    ///< so far
    std::int64_t memory_mb = 0;  ///< resident now
};

/// The environment variable that marks every process of an attempt.
constexpr const char* attempt_mark = "BREACHLINE_ATTEMPT";

/// Removes files of an attempt with the same number that the store does not know, because it was
/// restored from a backup. Its exit record would be mistaken for that of the new attempt.
void remove_remains(const AttemptFolder& folder);

void write_order(const AttemptFolder& folder, const Order& order);
Order read_order(const AttemptFolder& folder);

void write_exit_record(const AttemptFolder& folder, const ExitRecord& record);
/// Nothing until there is one.
std::optional<ExitRecord> read_exit_record(const AttemptFolder& folder);

/// The file's time shows that the attempt is alive even if the disk is full.
void write_heartbeat(const AttemptFolder& folder, const Heartbeat& beat);
/// Nothing: there is none, or its text was being written.
std::optional<Heartbeat> read_heartbeat(const AttemptFolder& folder);

/// Asks the supervisor to stop the attempt; a second request keeps the first reason.
void write_stop(const AttemptFolder& folder, StopReason reason);
std::optional<StopReason> read_stop(const AttemptFolder& folder);

}  // namespace breach::orchestrator
