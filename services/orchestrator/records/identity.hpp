// Names and times: sortable unique ids of runs, tasks and attempts; what snapshots are called;
// ISO-8601 UTC.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace breach::orchestrator {

/// 26 characters, ascending in time of creation, unique (48 bits of milliseconds, 80 random bits).
std::string new_run_id();
/// "<run>-00007"; ascending in the order of the graph.
std::string task_id(const std::string& run, std::size_t ordinal);
/// "<task>.2"
std::string attempt_id(const std::string& task, std::int64_t number);

/// "0.500000": how a time is spelt in the names of snapshots and tasks.
std::string spelt(double time);
/// "snapshot_0.500000.vtkhdf"
std::string snapshot_name(double time);

/// Now as "2026-11-21T02:38:53.123Z".
std::string utc_now();
/// Milliseconds since 1970, for stored retry times.
std::int64_t epoch_ms();

}  // namespace breach::orchestrator
