// Variants that came to the same numbers: what tells them apart has no part in the run, and a reader
// who takes that for "it does not matter" should be told.
#pragma once

#include "services/orchestrator/records/result_columns.hpp"

namespace breach::orchestrator {

/// Groups of these variants, two or more each, in their order. In a group every number that the MPM and
/// the stability analysis measured is the same to the last digit at each transfer time that ended in
/// both variants, and there is one at least.
std::vector<std::vector<std::string>> same_results(const std::vector<ResultRow>& rows,
                                                   const std::vector<std::string>& variants);

}  // namespace breach::orchestrator
