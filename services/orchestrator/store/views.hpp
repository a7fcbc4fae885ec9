// The views that people and this program read: run_summaries and sweep_results. They hold no data,
// so they belong to the program and not to a version of the database: made anew when they differ.
#pragma once

#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

bool views_are_current(Connection& database);
void make_views(Connection& database);

/// The SQL condition on a task by which it makes a row of sweep_results: an MPM, or the stability
/// analysis of a run that has nothing else.
std::string makes_a_row(const std::string& task);
/// The SQL condition on a trigger's spec by which it draws more samples (ensemble/batch_watch.hpp) and
/// watches no FEM.
std::string draws_samples(const std::string& spec);
/// Of the transfers that triggers make; empty: the run has none.
std::vector<TaskPlan> firing_plan_of(Connection& database, const std::string& run);
/// In the order of the run's plan.
std::vector<WithoutTransfer> variants_without_transfer(Connection& database,
                                                       const std::string& run);
/// SQL: of the result of a stability analysis the factor of safety with every layer liquefied that may;
/// NULL: none may.
std::string factor_liquefied(const std::string& result);
/// "state, runout, ...": what is read of sweep_results for one ResultRow.
std::string selected_result_columns();
/// The same of sweep_means, for one row of mean_columns().
std::string selected_mean_columns();
/// The statement of the view sweep_means, of those rows of sweep_results that meet the condition
/// ("AND run=?"; empty: all). A condition on the view itself would be met only after all runs of
/// the database have been averaged. One row per variant and transfer time of a study with draws;
/// the standard deviation is that of the differences from the mean, so that close values keep their
/// digits.
std::string selected_means(const std::string& condition);

}  // namespace breach::orchestrator
