// Advice on transfer times: the window of /transfer/window over a FEM's telemetry, found by the
// code of a study's window trigger, and the signs that confirm it. Sordo et al. 2024: after the
// failure has developed, before the mesh is too distorted, half-way between.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/criteria/window.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

/// A condition on the telemetry that confirms an edge of the window.
struct Sign {
    std::string name;            ///< "energy growth"
    std::string condition;       ///< as evaluated
    bool known;                  ///< whether the telemetry has its fields
    std::vector<double> onsets;  ///< every time at which it became true [s]
};

/// The first time at which a condition of the window was true for its hold.
struct Edge {
    std::string condition;
    double time;                           ///< [s]
    std::map<std::string, double> values;  ///< of its fields on that line
};

struct Advice {
    double begin = 0.0;  ///< of the telemetry [s]
    double end = 0.0;
    std::optional<Edge> lower;         ///< nothing: the failure has not developed
    std::optional<Edge> upper;         ///< nothing: the window ends with the telemetry
    std::optional<double> shut_since;  ///< too distorted before the lower edge: no window [s]
    std::vector<double> snapshots;     ///< in the window [s]
    std::optional<double> half_way;    ///< between the edges [s]
    std::optional<double> pick;        ///< the snapshot to take [s]
    std::vector<Sign> signs;
    std::vector<std::string> missing;  ///< fields of the window that the telemetry lacks

    /// The end of the window: the upper edge, or the telemetry's end [s].
    double until() const { return upper ? upper->time : end; }
};

/// The window's conditions, parsed. Throws BadInput with the JSON pointer of an invalid condition,
/// or when the scene has no /transfer/window.
criteria::Window window_of(const scene::Scene& scene);

/// snapshots: times at which the FEM wrote one, ascending [s].
Advice advise(const scene::Scene& scene, const std::vector<telemetry::Line>& telemetry,
              const std::vector<double>& snapshots);

/// Times in the names of a folder's snapshots, ascending [s].
std::vector<double> snapshot_times(const std::filesystem::path& folder);

/// A few lines for people.
std::string as_text(const Advice& advice);

}  // namespace breach::transfer
