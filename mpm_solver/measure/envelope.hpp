// What every column of the grid has seen of the flow so far: the largest of it, when it came, and its
// depth over x and time. Seen every few steps; no frames are needed.
#pragma once

#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

/// Steps between two looks of the envelope. Measured in docs/reference/flow.md: what that costs, and how
/// far it is from looking after every step.
inline constexpr std::int64_t steps_between_samples = 16;
/// Rows of the depth over time that are kept; when they are full every second one goes.
inline constexpr std::size_t most_rows = 256;

/// Per column of profile_places. What never came: 0, and -1 for a time.
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

    /// Takes in the flow at `now`; nothing where that has been seen.
    void see(double now, const std::vector<Flow>& profile, double arrival_depth);
};

/// As it is, under "<prefix>envelope.", for a checkpoint, and back; load throws std::out_of_range where
/// an array is absent or not as long as the columns ask.
void store(const Envelope& envelope, const std::string& prefix, exchange::Archive& archive);
Envelope load_envelope(const exchange::Archive& archive, const std::string& prefix,
                       std::size_t columns);

/// For a reader: with x and the deposit `last`, and not a number where a time never came.
void publish(const Envelope& envelope, const FlowView& view, const std::vector<Flow>& last,
             exchange::Archive& archive);

}  // namespace breach::mpm
