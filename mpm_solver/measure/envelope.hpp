// Maxima of the flow in every column of the grid with their times, and its depth over x and time.
// Sampled every few steps, without frames.
// Simulation samples it (every 16 steps and at each measurement): frames would miss peaks.
#pragma once

#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

/// Steps between two samples. docs/reference/flow.md gives the cost and the difference from
/// sampling every step.
inline constexpr std::int64_t steps_between_samples = 16;
/// Rows of the depth over time; when they are full, every second one is dropped.
inline constexpr std::size_t most_rows = 256;

/// [columns of profile_places]. Not reached: 0, and -1 for a time.
struct Envelope {
    static constexpr double never = -1.0;
    std::vector<double> depth;         ///< maximum [m]
    std::vector<double> velocity;      ///< largest |mean v_x| with at least the arrival depth [m/s]
    std::vector<double> flux;          ///< largest depth x velocity^2 [m3/s2]
    std::vector<double> arrival;       ///< first time with the arrival depth [s]
    std::vector<double> time_of_peak;  ///< first time of the largest depth [s]
    std::vector<double> last_depth;    ///< at `time` [m]
    double time = never;               ///< of the last sample [s]
    std::vector<double> row_times;     ///< of the rows [s]
    std::vector<double> row_depths;    ///< [rows * columns] [m]
    double interval = 0.0;             ///< least time between rows [s]

    /// Adds the flow at `now`, unless already added.
    void see(double now, const std::vector<Flow>& profile, double arrival_depth);
};

/// Stores it in a checkpoint under "<prefix>envelope.", and loads it. Loading throws
/// std::out_of_range for a missing array or a wrong length.
void store(const Envelope& envelope, const std::string& prefix, exchange::Archive& archive);
Envelope load_envelope(const exchange::Archive& archive, const std::string& prefix,
                       std::size_t columns);

/// Writes the result: with x and the deposit `last`; NaN for times not reached.
void publish(const Envelope& envelope, const FlowView& view, const std::vector<Flow>& last,
             exchange::Archive& archive);

}  // namespace breach::mpm
