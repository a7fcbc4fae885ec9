// What a scene will cost before anything runs: how much there is to compute, CPU seconds and bytes of
// each phase, as ranges. From the scene alone, better with its mesh, best with earlier runs of it.
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

/// What is known of a mesh that exists.
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

/// Of every phase that the scene has a part for. Ranges reach from half to twice the likeliest. Where
/// soil flows to rest its time is guessed from its height and from whether it has friction left.
std::vector<PhaseCost> cost_of(const scene::Scene& scene,
                               const std::optional<MeshCounts>& mesh = {});

/// A phase that has run: what it took over what cost_of says of its own scene.
struct Earlier {
    std::string phase;
    std::string scene;  ///< its name
    double cpu_ratio;   ///< over the middle of the range
    double bytes_ratio;
};

/// Moves the ranges to what earlier runs took, from their least to their largest ratio: of a scene of
/// the same name where there are any, widened by a quarter, or by half for one run alone; else of
/// others, widened by the factor of two that they know no better. The mean of many goes by the mean
/// ratio, widened by half. Phases that have not run stay.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier);

/// How often a study runs each phase as far as its document says so: draws, variants (or samples) and
/// transfer times multiplied; what triggers add is not known.
struct Repeats {
    double runouts = 1.0;
    double variants = 1.0;
    std::map<std::string, double> tasks = {};  ///< by phase, where they have been planned: exact
};
/// Of a study, checked or not; of anything else one.
Repeats repeats_of(const nlohmann::json& document);

/// Lines for people: one per phase, and their sum.
std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const Repeats& repeats);
/// With those lines.
nlohmann::json as_json(const std::vector<PhaseCost>& costs, const Repeats& repeats);

}  // namespace breach::estimate
