// The table of a sweep's means, if its study has repeats: one row per variant and transfer time,
// mean and standard deviation over the repeats of every number of the table of results. Generated
// from result_columns(), so a number added there is added here.
#pragma once

#include <span>

#include "services/orchestrator/records/result_columns.hpp"

namespace breach::orchestrator {

/// In the order of the CSV; pointers are empty. The standard deviation of "runout" is
/// "runout_deviation".
std::span<const ResultColumn> mean_columns();

/// The numbers of the table of results that are averaged.
std::vector<const ResultColumn*> averaged_columns();

/// "runout" -> "runout_deviation"
std::string deviation_of(std::string_view column);

}  // namespace breach::orchestrator
