// Statistics of a study over distributions from the service (uncertainty.json, envelopes.json), and
// from its runouts: samples that are lower bounds, and the spread of any entry of their results.
#pragma once

#include <optional>

#include "services/report/read/run_folder.hpp"

namespace breach::report {

bool has_samples(const Run& run);

/// Whether its samples are the steps of a search for one value: they have no distribution.
bool is_back_analysis(const Run& run);

/// Of one of the answer's quantities, {"p", "value", "low", "high"}; null: too few samples.
const nlohmann::json* percentile_in(const nlohmann::json& quantity, double p);
/// Why there is none: "3 samples are not enough", with the number needed where that is known.
std::string why_no_percentile(const nlohmann::json& quantity, double p);

/// Runouts of samples that have a result, in the order of the samples.
std::vector<const PhaseFolder*> sampled_runouts(const Run& run);
/// Those with soil that still moved when they were stopped.
std::vector<const PhaseFolder*> moving_samples(const Run& run);
/// Whether some sample at or below this value of the quantity was stopped while it grew: a
/// percentile with that value is then a lower bound.
bool is_lower_bound(const Run& run, const std::string& quantity, double value);

/// An entry of the results over the samples that have one. If the entry is missing (a gauge that
/// the flow never reached) it counts as `absent`: infinity for a time, 0 for a depth.
struct Spread {
    std::size_t count = 0;  ///< samples with a number of their own
    std::size_t of = 0;
    std::vector<double> ascending = {};  ///< [of]
    /// Linear between order statistics; nothing: too few samples; infinity: never.
    std::optional<double> percentile(double p) const;
};
Spread spread_of(const Run& run, const nlohmann::json::json_pointer& fact, double absent);

}  // namespace breach::report
