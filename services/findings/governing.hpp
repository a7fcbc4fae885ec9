// Which result of a run governs: the one that first lines, pictures and comparisons are about.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace breach::findings {

/// What decides about one result.
struct Candidate {
    std::optional<double> runout = {};  ///< [m]
    std::optional<double> mean_runout =
        {};  ///< of all repeats of it [m]; nothing: it is not repeated
    std::optional<double> factor_of_safety = {};
};

/// The place of the largest runout; of repeated runouts of the largest one in the largest mean; without any runout
/// of the least factor of safety. Nothing: there is neither.
std::optional<std::size_t> governing(const std::vector<Candidate>& candidates);

}  // namespace breach::findings
