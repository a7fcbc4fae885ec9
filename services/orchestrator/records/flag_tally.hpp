// What the flags of a run's results amount to: how many results have which, and one line that says
// why a run is questionable.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace breach::orchestrator {

/// Results of one phase that carry one flag.
struct FlagTally {
    std::string code;
    std::string phase;
    bool questionable;
    std::int64_t results;     ///< that carry it
    std::int64_t of_results;  ///< that the phase gave; counted only where it is questionable
};

/// By code: the results that carry it, of the phase with the most.
std::map<std::string, std::int64_t> counts_of(const std::vector<FlagTally>& tallies);

/// "7 of 8 runouts still moving: lower bounds"; empty when nothing is questionable.
std::string doubt_of(const std::vector<FlagTally>& tallies);

}  // namespace breach::orchestrator
