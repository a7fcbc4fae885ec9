// Error of a runout of any sweep: from an accuracy study of the same scene at the same setting, else
// noise (repeats, neighbours in transfer time) and the bias of the cells.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

using AllRows = std::function<const std::vector<ResultRow>&()>;

/// Fills the columns runout_error and runout_error_from. Finds an accuracy study by recipe: its
/// rung and the row have equal recipes of MPM and transfer, and of the FEM except the times of its
/// snapshots. So its error, measured at one transfer time, is used at others, too.
///
/// rows: some of the run's, or all; all_rows: returns all, including neighbours and repeats. Called
/// only if needed.
///
/// means: of the run's repeats, with columns of the same names (records/mean_columns.hpp). The
/// error of a mean is the bias, from an accuracy study or of the cells, and the remaining scatter of so
/// few repeats.
void tell_runout_errors(const Store& store, const DataFolder& data, const std::string& run,
                        std::vector<ResultRow>& rows, std::vector<ResultRow>& means,
                        const AllRows& all_rows);

/// Fills the error of the run's governing runout. Not of samples: their spread is the answer.
void tell_governing_error(const Store& store, const DataFolder& data, Run& run);

}  // namespace breach::orchestrator
