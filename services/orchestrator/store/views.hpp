// The views that people and this program read: run_summaries and sweep_results. They hold no data,
// so they belong to the program and not to a version of the database: made anew when they differ.
#pragma once

#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

bool views_are_current(Connection& database);
void make_views(Connection& database);

/// "state, runout, ...": what is read of sweep_results for one ResultRow.
std::string selected_result_columns();

}  // namespace breach::orchestrator
