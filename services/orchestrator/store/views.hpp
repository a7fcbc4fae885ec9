// The SQL views for people and for this program: run_summaries and sweep_results. They hold no data
// and so belong to the program, not to a database version: recreated when they differ.
#pragma once

#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

bool views_are_current(Connection& database);
void make_views(Connection& database);

/// The SQL condition on a task that gives a row of sweep_results: an MPM, or the stability analysis
/// of a run that has nothing else.
std::string makes_a_row(const std::string& task);
/// The SQL condition on a trigger's spec that adds samples (ensemble/batch_watch.hpp) and watches no
/// FEM.
std::string draws_samples(const std::string& spec);
/// The tasks of transfers by triggers; empty: the run has none.
std::vector<TaskPlan> firing_plan_of(Connection& database, const std::string& run);
/// In the order of the run's plan.
std::vector<WithoutTransfer> variants_without_transfer(Connection& database,
                                                       const std::string& run);
/// SQL: from the result of a stability analysis the factor of safety with every layer liquefied that
/// can liquefy; NULL: none can.
std::string factor_liquefied(const std::string& result);
/// "state, runout, ...": the columns of sweep_results for one ResultRow.
std::string selected_result_columns();
/// The same of sweep_means, for one row of mean_columns().
std::string selected_mean_columns();
/// The statement of the view sweep_means, for those rows of sweep_results that meet the
/// condition ("AND run=?"; empty: all). A condition on the view itself would average all runs of
/// the database first. One row per variant and transfer time of a study with repeats; the
/// standard deviation is computed from differences from the mean, so that close values keep
/// their digits.
std::string selected_means(const std::string& condition);

}  // namespace breach::orchestrator
