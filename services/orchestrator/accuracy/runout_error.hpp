// How far a runout of any sweep is off, where something tells it: an accuracy study of the same
// scene at the same setting, the repeats that the sweep itself asks for, or its neighbours in transfer
// time. Else nothing, with the reason.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

using AllRows = std::function<const std::vector<ResultRow>&()>;

/// Fills the columns runout_error and runout_error_from. An accuracy study is found by recipe: its
/// rung and the row have equal recipes of MPM and transfer, and of the FEM but for the times of its
/// snapshots. So its error, measured at one transfer time, is told at others, too.
///
/// rows: some of the run's, or all; all_rows: gives all, which neighbours and draws are among. It is
/// called only where they are needed.
///
/// means: of the run's draws, with columns of the same names (records/mean_columns.hpp). A mean is
/// off by the bias that an accuracy study tells and by what scatter leaves of so few draws.
void tell_runout_errors(const Store& store, const DataFolder& data, const std::string& run,
                        std::vector<ResultRow>& rows, std::vector<ResultRow>& means,
                        const AllRows& all_rows);

}  // namespace breach::orchestrator
