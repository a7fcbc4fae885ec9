// Cost of a scene before anything runs: problem size, CPU seconds and bytes of each phase, as ranges.
// From the scene alone, better with its mesh, best with earlier runs of it.
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
    std::vector<std::pair<std::string, double>> counts;  ///< "elements", how many
    Range cpu_seconds;                                   ///< [s]
    Range bytes;                                         ///< on disk
    std::string basis;                                   ///< where the ranges come from
    Range mean_cpu_seconds = {0.0, 0.0};                 ///< of many such runs [s]
    Range mean_bytes = {0.0, 0.0};
};

/// Cost of every phase in the scene. Ranges reach from half to twice the likeliest. Where soil flows
/// to rest its time is guessed from its height and from whether it has friction left.
std::vector<PhaseCost> cost_of(const scene::Scene& scene,
                               const std::optional<MeshCounts>& mesh = {});

/// An earlier run of a phase: its cost over the cost_of for its own scene.
struct Earlier {
    std::string phase;
    std::string scene;  ///< its name
    double cpu_ratio;   ///< over the middle of the range
    double bytes_ratio;
};

/// Moves the ranges to the ratios of earlier runs, from the least to the largest: of a scene of the
/// same name if there are any, widened by a quarter, or by half for one run alone; else of other
/// scenes, widened by a factor of two as they are less similar. The mean of many runs uses the mean
/// ratio, widened by half. Phases without earlier runs are unchanged.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier);

/// How often a study runs each phase according to its document: repeats, variants (or samples) and
/// transfer times multiplied; tasks from triggers are not known.
struct Repeats {
    double runouts = 1.0;
    double variants = 1.0;
    std::map<std::string, double> tasks = {};  ///< by phase, where planned: exact
};
/// For a study, checked or not; for any other document 1.
Repeats repeats_of(const nlohmann::json& document);

/// Text lines: one per phase, and their sum.
std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const Repeats& repeats);
/// Includes those lines.
nlohmann::json as_json(const std::vector<PhaseCost>& costs, const Repeats& repeats);

}  // namespace breach::estimate
