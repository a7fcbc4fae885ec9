// What a study over distributions says, as the service told it (uncertainty.json, envelopes.json),
// beside what its runouts left: which samples are lower bounds, and the spread of any fact of theirs.
#pragma once

#include <optional>

#include "services/report/read/run_folder.hpp"

namespace breach::report {

bool has_samples(const Run& run);

/// Its samples are the steps of a search for one value: they have no distribution.
bool is_back_analysis(const Run& run);

/// Of one of the answer's quantities, {"p", "value", "low", "high"}; null: not told of so few.
const nlohmann::json* percentile_in(const nlohmann::json& quantity, double p);
/// Why it is not told: "3 samples are not enough", with how many are needed where that is known.
std::string why_no_percentile(const nlohmann::json& quantity, double p);

/// Runouts of samples that have a result, in the order of the samples.
std::vector<const PhaseFolder*> sampled_runouts(const Run& run);
/// Those among them whose soil still moved when they were stopped.
std::vector<const PhaseFolder*> moving_samples(const Run& run);
/// Some sample at or below this value of the quantity was stopped while it grew: a percentile of the
/// value is a lower bound then.
bool is_lower_bound(const Run& run, const std::string& quantity, double value);

/// A fact over the samples that have a result. Where it is not there (a gauge that the flow never
/// came to) it counts as `absent`: infinity for a time, 0 for a depth.
struct Spread {
    std::size_t count = 0;  ///< samples with a number of their own
    std::size_t of = 0;
    std::vector<double> ascending = {};  ///< [of]
    /// Linear between order statistics; nothing of too few samples; infinity: never.
    std::optional<double> percentile(double p) const;
};
Spread spread_of(const Run& run, const nlohmann::json::json_pointer& fact, double absent);

}  // namespace breach::report
