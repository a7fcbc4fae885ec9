// Reads the envelopes of runouts (envelope.csv, one line per column of the grid), and combines them
// over an ensemble. Called for each request: a study's bands change with every sample.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace breach::outflow {

/// Envelope of one runout at each x; NaN: time that was not reached.
struct Envelope {
    std::vector<double> x{};                      ///< ascending [m]
    std::vector<double> largest_depth{};          ///< [m]
    std::vector<double> largest_velocity{};       ///< [m/s]
    std::vector<double> largest_momentum_flux{};  ///< [m3/s2]
    std::vector<double> arrival{};                ///< [s]
    std::vector<double> time_of_peak{};           ///< [s]
    std::vector<double> final_depth{};            ///< [m]
};

/// Calls visit(name, unit, values) for every quantity.
template <class AnyEnvelope, class Visit>
void for_each_quantity(AnyEnvelope& envelope, Visit&& visit) {
    visit("largest_depth", "m", envelope.largest_depth);
    visit("largest_velocity", "m/s", envelope.largest_velocity);
    visit("largest_momentum_flux", "m3/s2", envelope.largest_momentum_flux);
    visit("arrival", "s", envelope.arrival), visit("time_of_peak", "s", envelope.time_of_peak);
    visit("final_depth", "m", envelope.final_depth);
}

/// Throws BadInput if the file is not such a table, IoError if it cannot be read.
Envelope read_envelope(const std::filesystem::path& file);

/// One quantity over the samples; NaN where so few samples were reached that the percentile falls
/// among the others. Percentiles are at each x by itself: a band is no runout that could happen.
struct Band {
    std::string quantity;
    std::string unit;
    std::vector<double> p10{};
    std::vector<double> p50{};
    std::vector<double> p90{};
    /// Samples with a value: for times those that the flow reached, else all.
    std::vector<std::size_t> rests_on{};
};

struct Ensemble {
    std::size_t samples = 0;
    std::vector<double> x{};             ///< of the coarsest grid [m]
    std::vector<std::size_t> reached{};  ///< samples whose flow arrived at x
    std::vector<Band> bands{};           ///< one per quantity, in the order of for_each_quantity
};

/// Percentiles over all samples, by linear interpolation between order statistics (as numpy's
/// default). A sample with flow that never reached an x has depth and velocity 0 there, and arrives
/// after all others. Samples on other grids are interpolated; beyond its grid a sample counts as
/// not reached.
Ensemble ensemble_of(std::span<const Envelope> samples);

/// {"x": [...], "largest_depth": {"unit", "values"}}; NaN is null.
nlohmann::json as_json(const Envelope& envelope);
/// {"samples", "x", "reached", "bands": {"arrival": {"unit", "p10", "p50", "p90", "rests_on"}}}
nlohmann::json as_json(const Ensemble& ensemble);

}  // namespace breach::outflow
