// Finds variants with identical results, so that views can say that their different entries have no
// effect.
#pragma once

#include "services/orchestrator/records/result_columns.hpp"

namespace breach::orchestrator {

/// Groups of two or more of these variants, in their order. In a group every number of the MPM and
/// of the stability analysis is equal to the last digit at each transfer time that ended in both
/// variants, and there is at least one such time.
std::vector<std::vector<std::string>> same_results(const std::vector<ResultRow>& rows,
                                                   const std::vector<std::string>& variants);

}  // namespace breach::orchestrator
