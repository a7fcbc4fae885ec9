// Maxima of the flow in every column of the grid so far, with their times, and its depth over x and
// time. Sampled every few steps; no frames are needed.
#pragma once

#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

/// Steps between two samples of the envelope. docs/reference/flow.md gives the cost, and the difference
/// from sampling after every step.
inline constexpr std::int64_t steps_between_samples = 16;
/// Number of kept rows of the depth over time; when they are full every second one is dropped.
inline constexpr std::size_t most_rows = 256;

/// Per column of profile_places. Not reached: 0, and -1 for a time.
struct Envelope {
    static constexpr double never = -1.0;
    std::vector<double> depth;         ///< largest [m]
    std::vector<double> velocity;      ///< largest |mean v_x| of a flow of arrival depth [m/s]
    std::vector<double> flux;          ///< largest depth x velocity^2 [m3/s2]
    std::vector<double> arrival;       ///< first time with the arrival depth [s]
    std::vector<double> time_of_peak;  ///< of the largest depth, its first [s]
    std::vector<double> last_depth;    ///< at `time` [m]
    double time = never;               ///< of the last sample [s]
    std::vector<double> row_times;     ///< of the rows [s]
    std::vector<double> row_depths;    ///< one row of columns after the other [m]
    double interval = 0.0;             ///< between rows, at least [s]

    /// Adds the flow at `now`, unless it was added already.
    void see(double now, const std::vector<Flow>& profile, double arrival_depth);
};

/// Stores it unchanged, under "<prefix>envelope.", in a checkpoint, and loads it; load throws
/// std::out_of_range where an array is absent or its length differs from the columns'.
void store(const Envelope& envelope, const std::string& prefix, exchange::Archive& archive);
Envelope load_envelope(const exchange::Archive& archive, const std::string& prefix,
                       std::size_t columns);

/// For results: with x and the deposit `last`, and NaN for times that were not reached.
void publish(const Envelope& envelope, const FlowView& view, const std::vector<Flow>& last,
             exchange::Archive& archive);

}  // namespace breach::mpm
