// Advice on transfer times: evaluates /transfer/window on a FEM's telemetry, like a study's window
// trigger, and the signs that confirm it. Sordo et al. 2024: after the failure has developed and
// before the mesh is too distorted, at the midpoint.
// For a person who chooses t_T by hand (`transfer_tool advise`). The service's window trigger uses
// the same core/criteria, so that both find the same window.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/criteria/window.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

/// A condition on the telemetry that confirms an edge of the window.
/// Signs inform only: `lower` and `upper` of the window decide.
struct Sign {
    std::string name;            ///< "energy growth"
    std::string condition;       ///< as evaluated
    bool known;                  ///< whether the telemetry has its fields
    std::vector<double> onsets;  ///< all times at which it became true [s]
};

/// When a condition of the window was first true for its hold.
struct Edge {
    std::string condition;
    double time;                           ///< [s]
    std::map<std::string, double> values;  ///< of its fields at that time
};

struct Advice {
    double begin = 0.0;  ///< beginning of the telemetry [s]
    double end = 0.0;
    std::optional<Edge> lower;  ///< none: the failure has not developed
    std::optional<Edge> upper;  ///< none: the window ends with the telemetry
    /// when the mesh became too distorted, before the lower edge: no window [s]
    std::optional<double> shut_since;
    std::vector<double> snapshots;   ///< in the window [s]
    std::optional<double> half_way;  ///< midpoint of the window [s]
    std::optional<double> pick;      ///< recommended snapshot [s]
    std::vector<Sign> signs;
    /// fields of the window's conditions that the telemetry lacks
    std::vector<std::string> missing;

    /// The end of the window: the upper edge, or the telemetry's end [s].
    double until() const { return upper ? upper->time : end; }
};

/// The window's conditions. Throws BadInput with the JSON pointer of an invalid condition, or if
/// the scene has no /transfer/window.
criteria::Window window_of(const scene::Scene& scene);

/// snapshots: times of the FEM's snapshots, ascending [s].
Advice advise(const scene::Scene& scene, const std::vector<telemetry::Line>& telemetry,
              const std::vector<double>& snapshots);

/// Times in the names of the folder's snapshots, ascending [s].
/// No snapshot is opened.
std::vector<double> snapshot_times(const std::filesystem::path& folder);

/// Text of a few lines.
std::string as_text(const Advice& advice);

}  // namespace breach::transfer
