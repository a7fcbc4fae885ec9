// Estimates the cost of a scene before a run: problem size, CPU seconds and bytes of each phase, as
// ranges. Uses the scene, its mesh if there is one, and earlier runs if there are any. Called for
// previews and by `breach draw`; the dispatcher does not ask it.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::estimate {

struct Range {
    double low, high;
    double middle() const;  ///< geometric
};

/// Size of an existing mesh.
struct MeshCounts {
    double elements;
    double nodes;
};

/// One run of one phase.
struct PhaseCost {
    std::string phase;                                   ///< its program
    std::vector<std::pair<std::string, double>> counts;  ///< "elements" and their number
    Range cpu_seconds;                                   ///< [s]
    Range bytes;                                         ///< on disk
    std::string basis;                                   ///< where the ranges come from
    Range mean_cpu_seconds = {0.0, 0.0};                 ///< mean over many such runs [s]
    Range mean_bytes = {0.0, 0.0};
};

/// Cost of every phase in the scene. Ranges reach from half to twice the likeliest value. The time
/// until soil rests is guessed from its height and from whether it keeps friction.
std::vector<PhaseCost> cost_of(const scene::Scene& scene,
                               const std::optional<MeshCounts>& mesh = {});

/// Cost of an earlier run of a phase, relative to cost_of for its own scene. The service's
/// EarlierCosts makes them; the CLI, which has no store, does without.
struct Earlier {
    std::string phase;
    std::string scene;  ///< its name
    double cpu_ratio;   ///< over the middle of the range
    double bytes_ratio;
};

/// Scales the ranges by the least and the largest ratio of earlier runs. Runs of a scene of the
/// same name come first: widened by a quarter, or by half for a single run. Otherwise other scenes
/// count, widened by a factor of two. The mean of many runs uses the mean ratio, widened by half.
/// Phases without earlier runs are unchanged.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier);

/// How often a study runs each phase, from its document: repeats, variants (or samples) and
/// transfer times multiplied, without tasks from triggers.
struct Repeats {
    double runouts = 1.0;
    double variants = 1.0;
    std::map<std::string, double> tasks = {};  ///< by phase, exact where tasks are planned
};
/// For a study, checked or not; 1 for any other document.
Repeats repeats_of(const nlohmann::json& document);

/// One text line per phase, and their sum.
std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const Repeats& repeats);
/// Includes lines_of.
nlohmann::json as_json(const std::vector<PhaseCost>& costs, const Repeats& repeats);

}  // namespace breach::estimate
