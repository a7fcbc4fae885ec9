// Names and times: sortable unique ids of runs, tasks and attempts; names of snapshots; ISO-8601
// UTC.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/phases/files.hpp"

namespace breach::orchestrator {

/// 26 characters, ascending in time of creation, unique (48 bits of milliseconds, 80 random bits).
std::string new_run_id();
/// "<run>-00007"; ascending in the order of the graph.
std::string task_id(const std::string& run, std::size_t ordinal);
/// "<task>.2"
std::string attempt_id(const std::string& task, std::int64_t number);

using phases::files::snapshot_name;
using phases::files::spelt;

/// Now as "2026-11-21T02:38:53.123Z".
std::string utc_now();
std::string utc_days_ago(double days);
/// A moment in milliseconds since 1970, in that form.
std::string utc_text(std::int64_t ms);
/// Milliseconds since 1970, for stored retry times.
std::int64_t epoch_ms();
/// Longest wait between a task's failure and its next try.
constexpr std::int64_t longest_retry_ms = 60000;

}  // namespace breach::orchestrator
