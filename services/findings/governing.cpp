// The farthest runout governs, by the mean of its repeats where there are any: a single repeat may
// be far by chance. Without a runout the least factor of safety does. The first of equal ones
// stays, so that the choice does not depend on later rows.
#include "services/findings/governing.hpp"

#include <array>
#include <limits>

namespace breach::findings {

std::optional<std::size_t> governing(const std::vector<Candidate>& candidates) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    std::array most{none, none, none};
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto& [runout, mean, factor] = candidates[i];
        // Compared from left to right: mean, then the repeat itself, then the factor.
        const std::array rank{runout ? mean.value_or(*runout) : none, runout.value_or(none),
                              !runout && factor ? -*factor : none};
        if (rank <= most) continue;
        most = rank;
        found = i;
    }
    return found;
}

}  // namespace breach::findings
