// Rebuilds the search for a parameter's value from the stored samples. Nothing of the search is
// stored but the values it asked for: BatchWatch asks for the next, requests for the present
// state.
#include "services/orchestrator/uncertainty/inverse_search.hpp"

#include <algorithm>

#include "core/statistics/repeats.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// These are 0 for a dam that stands, so a standing sample is a result. The absolute runout has no
/// such value.
bool is_none_where_nothing_flows(const std::string& quantity) {
    return quantity == "runout_beyond_toe" || quantity == "area_beyond_toe";
}

}  // namespace

std::optional<InverseSearch> inverse_search(const Ensemble& ensemble, const json& scene) {
    if (!ensemble.entry.contains("target")) return std::nullopt;
    std::vector<fault::Fault> none;  // the study was checked when it was accepted
    const UncertaintyPlan plan = read_uncertainty(ensemble.entry, scene, none);
    InverseSearch search{
        .target = read_target(ensemble.entry, plan, Reach::chain, none), .steps = {}, .advice = {}};
    const std::string& quantity = search.target.question.quantity;
    const std::string& vary = plan.parameters.at(search.target.parameter).name;
    for (const double value : search.target.values) {
        statistics::InverseStep step{.value = value, .results = {}};
        for (const SampleRow& each : ensemble.samples) {
            if (each.drawn.at(vary) != value) continue;
            // A cancelled run leaves samples open that no one will compute.
            step.open |= each.end == SampleEnd::open && !ensemble.run.finished;
            if (each.end == SampleEnd::no_transfer && is_none_where_nothing_flows(quantity)) {
                step.results.push_back(0.0);
                ++step.stood;
            }
            const auto result = result_of(each, quantity);
            if (!result) continue;
            step.results.push_back(*result);
            if (is_lower_bound(each, quantity)) ++step.moving;
        }
        search.steps.push_back(std::move(step));
    }
    // The values are stored in the order of their requests; the search needs them ascending.
    std::ranges::sort(search.steps, {}, &statistics::InverseStep::value);
    search.advice = statistics::advise_inverse(search.target.question, search.steps);
    return search;
}

json as_json(const InverseSearch& search, const std::string& vary) {
    const statistics::InverseAdvice& advice = search.advice;
    json steps = json::array();
    for (const statistics::InverseStep& each : search.steps) {
        // All its lattices ended, none with a result.
        const bool failed = each.results.empty() && !each.open;
        steps.push_back(
            {{"value", each.value},
             {"results", each.results},
             {"lower_bounds", each.moving},
             {"result",
              each.results.empty() ? json() : json(statistics::repeats_of(each.results).mean)},
             {"state", each.open ? "open"
                       : failed  ? "failed"
                                 : "done"}});
    }
    const char* bound = advice.bound == statistics::Bound::at_least  ? "at_least"
                        : advice.bound == statistics::Bound::at_most ? "at_most"
                                                                     : nullptr;
    const bool interval = advice.found && advice.has_interval;
    return {{"quantity", search.target.question.quantity},
            {"unit", search.target.question.unit},
            {"target", search.target.question.target},
            {"vary", vary},
            {"state", advice.found             ? "found"
                      : advice.refused.empty() ? "running"
                                               : "refused"},
            {"value", advice.found ? json(advice.found->value) : json()},
            {"bound", bound ? json(bound) : json()},
            {"low", interval ? json(advice.found->low) : json()},
            {"high", interval ? json(advice.found->high) : json()},
            {"reason", advice.refused.empty() ? advice.remark : advice.refused},
            {"noise", or_null(advice.noise)},
            {"steps", std::move(steps)}};
}

}  // namespace breach::orchestrator
