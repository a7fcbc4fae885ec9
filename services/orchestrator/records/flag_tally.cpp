#include "services/orchestrator/records/flag_tally.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/phases/phases.hpp"

namespace breach::orchestrator {

namespace {

constexpr std::array<std::pair<const char*, const char*>, 8> doubts{{
    {"still_moving", "still moving: lower bounds"},
    {"numerical_share", "with much energy made or lost by the numerics"},
    {"volume_ratio", "that did not keep the volume"},
    {"overlap", "with soil lying in soil"},
    {"liquefied_gap", "with walls of sound soil too thin for the cells"},
    {"coarse_cells", "on cells too coarse"},
    {"coarse_elements", "on elements too coarse"},
    {"entangled_corner", "ended by one bad corner of the mesh"},
}};

std::string words_for(const std::string& code) {
    for (const auto& [known, words] : doubts)
        if (code == known) return words;
    return "flagged " + code;
}

std::string results_of(const std::string& phase) {
    const phases::Phase* known = phases::named(phase);
    return known ? known->results : "results of " + phase;
}

}  // namespace

std::map<std::string, std::int64_t> counts_of(const std::vector<FlagTally>& tallies) {
    std::map<std::string, std::int64_t> counts;
    for (const FlagTally& each : tallies)
        counts[each.code] = std::max(counts[each.code], each.results);
    return counts;
}

std::string doubt_of(const std::vector<FlagTally>& tallies) {
    std::string doubt;
    for (const FlagTally& each : tallies) {
        if (!each.questionable) continue;
        // What several phases find in one scene is said of the one that has it most often.
        const auto counts_more = [&](const FlagTally& other) {
            return other.questionable && other.code == each.code && other.results > each.results;
        };
        if (std::ranges::any_of(tallies, counts_more)) continue;
        if (!doubt.empty()) doubt += "; ";
        doubt += std::to_string(each.results) + " of " + std::to_string(each.of_results) + " " +
                 results_of(each.phase) + " " + words_for(each.code);
    }
    return doubt;
}

}  // namespace breach::orchestrator
