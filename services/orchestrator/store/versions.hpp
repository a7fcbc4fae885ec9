// The SQL that leads from one version of the database to the next. Append only: what has been
// shipped once is never edited, because databases of that version exist.
#pragma once

namespace breach::orchestrator {

extern const char* const version_1;   ///< runs, tasks, attempts, events, artifacts
extern const char* const version_2;   ///< variants, cache, queues, idempotency, counts per run
extern const char* const version_3;   ///< triggers, firings
extern const char* const version_4;   ///< indices for thousands of tasks
extern const char* const version_5;   ///< breakdowns answer equal tasks
extern const char* const version_6;   ///< flags of results, order of variants
extern const char* const version_7;   ///< what the FEM did not reach is no failure
extern const char* const version_8;   ///< accuracy studies are found at once
extern const char* const version_9;   ///< which variant a draw repeats
extern const char* const version_10;  ///< runs are removed and pinned; files that were sent
extern const char* const version_11;  ///< budgets; scenes that were stored

}  // namespace breach::orchestrator
