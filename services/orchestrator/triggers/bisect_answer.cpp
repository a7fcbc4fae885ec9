#include "services/orchestrator/triggers/bisect_answer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/statistics/repeats.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/triggers/watched_fem.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Decided by a mean that may lie on the other side of the level: its own scatter and that of the
/// largest, of which the level is a share.
bool straddles(const statistics::Repeats& sample, const statistics::Repeats& largest,
               double share) {
    const double half = statistics::half_width_of_mean(sample).value_or(0.0);
    const double of_level = share * statistics::half_width_of_mean(largest).value_or(0.0);
    return std::abs(sample.mean - share * largest.mean) <= std::hypot(half, of_level);
}

/// Where the study has draws: which times were decided by a mean whose band straddles the level,
/// and which by fewer draws than were asked for.
void tell_draws(const std::vector<Sample>& samples, double share,
                const std::optional<statistics::Plateau>& plateau, json& result) {
    const auto repeated = std::ranges::max_element(samples, {}, &Sample::draws);
    if (repeated == samples.end() || repeated->draws < 2) return;
    result["draws"] = repeated->draws;
    result["straddling"] = json::array();
    result["with_fewer_draws"] = json::array();
    for (const Sample& each : samples)
        if (each.runouts.size() < each.draws)
            result["with_fewer_draws"].push_back(each.transfer_time);
    if (!plateau) return;
    const auto top = std::ranges::find(samples, plateau->largest_at, &Sample::transfer_time);
    const statistics::Repeats largest = statistics::repeats_of(top->runouts);
    for (const Sample& each : samples) {
        if (each.runouts.empty() || &each == &*top) continue;
        const statistics::Repeats sample = statistics::repeats_of(each.runouts);
        if (straddles(sample, largest, share))
            result["straddling"].push_back(
                {{"transfer_time", each.transfer_time},
                 {"runout", sample.mean},
                 {"half_width", statistics::half_width_of_mean(sample).value_or(0)}});
    }
}

json as_json(const statistics::Edge& edge) { return {{"off", or_null(edge.off)}, {"on", edge.on}}; }

}  // namespace

std::vector<Frame> candidates_of(const Bisect& bisect, const std::vector<Frame>& snapshots) {
    std::vector<Frame> found;
    for (const Frame& each : snapshots) {
        const bool inside =
            each.time >= bisect.from - snapshot_slack && each.time <= bisect.to + snapshot_slack;
        const bool apart =
            found.empty() || each.time - found.back().time >= bisect.tolerance - snapshot_slack;
        if (inside && apart) found.push_back(each);
    }
    return found;
}

statistics::Advice advice_for(const Bisect& bisect, const std::vector<Frame>& candidates,
                              const std::vector<Sample>& samples) {
    std::vector<double> times;
    std::vector<std::optional<double>> runouts;
    for (const Frame& each : candidates) {
        times.push_back(each.time);
        const auto sample = std::ranges::find(samples, each.time, &Sample::transfer_time);
        runouts.push_back(sample == samples.end()   ? std::nullopt
                          : sample->runouts.empty() ? std::optional(statistics::no_runout)
                                                    : statistics::repeats_of(sample->runouts).mean);
    }
    return statistics::advise(times, runouts, bisect.share, bisect.seeds);
}

json result_of(const Bisect& bisect, const std::vector<Frame>& candidates,
               const std::vector<Sample>& samples, const statistics::Advice& advice) {
    json result{{"runs", samples.size()},
                {"uniform_runs", candidates.size()},
                {"complete", advice.run_next.empty()}};
    tell_draws(samples, bisect.share, advice.plateau, result);
    if (!advice.plateau) return result;
    result["lower"] = as_json(advice.plateau->lower);
    result["upper"] = as_json(advice.plateau->upper);
    result["largest_runout"] = advice.plateau->largest;
    result["largest_at"] = advice.plateau->largest_at;
    return result;
}

}  // namespace breach::orchestrator
