// The SQL views for people and for this program. They hold no data and belong to the program, so
// they are recreated when they differ.
#pragma once

#include "services/orchestrator/records/records.hpp"
#include "services/orchestrator/store/connection.hpp"

namespace breach::orchestrator {

bool views_are_current(Connection& database);
void make_views(Connection& database);

/// SQL condition on a task that has a row in sweep_results: an MPM, or the stability analysis of a
/// run that has nothing else.
std::string makes_a_row(const std::string& task);
/// The tasks of one more transfer; empty: the run has none.
std::vector<TaskPlan> firing_plan_of(Connection& database, const std::string& run);
/// In the order of the run's plan.
std::vector<WithoutTransfer> variants_without_transfer(Connection& database,
                                                       const std::string& run);
/// SQL: the factor of safety of a stability analysis with every layer liquefied that can liquefy;
/// NULL: no layer can.
std::string factor_liquefied(const std::string& result);
/// "state, runout, ...": the columns of sweep_results for one ResultRow.
std::string selected_result_columns();
std::string selected_mean_columns();
/// Statement of the view sweep_means, for the rows of sweep_results that meet the condition ("AND
/// run=?"; empty: all). A condition on the view itself would first average all runs of the
/// database. One row per variant and transfer time of a study with repeats. The standard deviation
/// uses differences from the mean, so that close values keep their digits.
std::string selected_means(const std::string& condition);

}  // namespace breach::orchestrator
