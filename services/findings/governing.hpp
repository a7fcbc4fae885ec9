// Selects the governing result of a run, for headlines, pictures and comparisons. The store asks it
// when it gathers a run's facts, so that all views show the same one.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace breach::findings {

/// The numbers of a result that decide.
struct Candidate {
    std::optional<double> runout = {};       ///< [m]
    std::optional<double> mean_runout = {};  ///< of all its repeats [m]; nothing: no repeats
    std::optional<double> factor_of_safety = {};
};

/// Index of the largest runout (with repeats: the largest runout within the largest mean); without
/// runouts, of the least factor of safety. Nothing: there is neither.
std::optional<std::size_t> governing(const std::vector<Candidate>& candidates);

}  // namespace breach::findings
