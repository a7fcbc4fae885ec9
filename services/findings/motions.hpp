// Findings of a study of several motions: the measure that correlates best with liquefaction and
// runout, the least liquefied depth with soil past the toe, and its probability for a given motion.
// All are of the motions that were chosen, not of the site's hazard.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace breach::findings {

/// A FEM and its results; without a runout it counts for the liquefied depth only.
struct Shaken {
    std::string variant;
    std::vector<double> measures;  ///< of the input, in the order of motion::named_measures
    double liquefaction_depth;     ///< largest [m]
    std::optional<double> runout =
        {};                    ///< beyond the toe, the largest of its runouts; 0: the dam stood [m]
    bool lower_bound = false;  ///< of the runout
};

/// Fewer motions give no findings.
inline constexpr std::size_t fewest_motions = 5;

/// {"rows", "measures": [{"name", "title", "unit", "with_depth", "with_runout", "fragility"}],
/// "best", "onset", "saturation", "sentences"}, as in services/orchestrator/http/openapi.json.
/// shaken: at least fewest_motions.
nlohmann::json motions_of(const std::vector<Shaken>& shaken);

}  // namespace breach::findings
