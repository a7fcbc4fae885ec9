// The governing result of a run: the one for first lines, pictures and comparisons.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace breach::findings {

/// The properties of a result that decide.
struct Candidate {
    std::optional<double> runout = {};  ///< [m]
    std::optional<double> mean_runout =
        {};  ///< of all repeats of it [m]; nothing: it is not repeated
    std::optional<double> factor_of_safety = {};
};

/// Index of the largest runout; of repeated runouts, of the largest one in the largest mean; without any runout,
/// of the least factor of safety. Nothing: there is neither.
std::optional<std::size_t> governing(const std::vector<Candidate>& candidates);

}  // namespace breach::findings
