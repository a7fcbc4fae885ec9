// Statistics of a study over distributions: from the service (uncertainty.json, envelopes.json),
// and from its runouts (lower bounds, spread of any entry of the results).
#pragma once

#include <optional>

#include "services/report/read/run_folder.hpp"

namespace breach::report {

bool has_samples(const Run& run);

/// Whether the samples are the steps of a search for one value, which have no distribution.
bool is_back_analysis(const Run& run);

/// A percentile, {"p", "value", "low", "high"}; null: too few samples.
const nlohmann::json* percentile_in(const nlohmann::json& quantity, double p);
/// Why it is null: "3 samples are not enough", with the number needed where known.
std::string why_no_percentile(const nlohmann::json& quantity, double p);

/// Runouts of samples that have a result, in the order of the samples.
std::vector<const PhaseFolder*> sampled_runouts(const Run& run);
/// Sampled runouts with soil that still moved at their end.
std::vector<const PhaseFolder*> moving_samples(const Run& run);
/// Whether a sample at or below this value of the quantity still moved at its end: a percentile
/// with that value is then a lower bound.
bool is_lower_bound(const Run& run, const std::string& quantity, double value);

/// An entry of the results over the samples that have a result. A missing entry (a gauge that the
/// flow never reached) counts as `absent`: infinity for a time, 0 for a depth.
struct Spread {
    std::size_t count = 0;  ///< samples that have the entry
    std::size_t of = 0;
    std::vector<double> ascending = {};  ///< [of]
    /// Linear between order statistics; nothing: too few samples; infinity: never reached.
    std::optional<double> percentile(double p) const;
};
Spread spread_of(const Run& run, const nlohmann::json::json_pointer& fact, double absent);

}  // namespace breach::report
