// Records of the scene's gauges: depth and velocity per row of the history.
// Simulation::look adds to them; telemetry, history.h5, result.json and checkpoints contain them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

struct GaugeRecord {
    std::vector<double> depth;     ///< [m]
    std::vector<double> velocity;  ///< [m/s]
};

/// In the order of Mpm::gauges.
using GaugeRecords = std::vector<GaugeRecord>;

/// Adds the present readings; zero for grains (flow.hpp).
void read_gauges(const std::vector<scene::Gauge>& gauges, const Points& points,
                 const FlowView& view, GaugeRecords& records);

/// First time with the depth `arrival_depth`, linear between readings; none if never reached.
std::optional<double> arrival_time(const std::vector<double>& times,
                                   const std::vector<double>& depth, double arrival_depth);

/// Stores and loads "<prefix>gauge.<name>.depth" and so on.
void store(const std::vector<scene::Gauge>& gauges, const GaugeRecords& records,
           const std::string& prefix, exchange::Archive& archive);
GaugeRecords load_gauges(const std::vector<scene::Gauge>& gauges, const exchange::Archive& archive,
                         const std::string& prefix);

}  // namespace breach::mpm
