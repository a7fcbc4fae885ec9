// Estimates the cost of a scene before a run: problem size, CPU seconds and bytes of each phase.
// Uses the scene, its mesh if there is one, and earlier runs if there are any. Called for
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

/// What is shown of a forecast: its likeliest value divided and multiplied by 1.7.
struct Range {
    double low, high;
};
Range range_around(double likely);

/// Size of an existing mesh.
struct MeshCounts {
    double elements;
    double nodes;
};

/// One run of one phase, as it is likely.
struct PhaseCost {
    std::string phase;                                   ///< its program
    std::vector<std::pair<std::string, double>> counts;  ///< "elements" and their number
    double cpu_seconds;                                  ///< on this machine [s]
    double bytes;                                        ///< on disk
    std::string basis;                                   ///< what the forecast rests on
};

/// Cost of every phase in the scene, at the speed of this machine (machine.hpp). The time until
/// soil rests is guessed from its height and its strength after softening.
std::vector<PhaseCost> cost_of(const scene::Scene& scene,
                               const std::optional<MeshCounts>& mesh = {});

/// Cost of an earlier run of a phase, relative to cost_of for its own scene. The service's
/// EarlierCosts makes them; the CLI, which has no store, does without.
struct Earlier {
    std::string phase;
    std::string scene;  ///< its name
    double cpu_ratio;
    double bytes_ratio;
};

/// Multiplies by the median ratio of earlier runs of the scene. Those of other scenes teach nothing:
/// the speed of the machine is measured, and what else differs is the scene.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier);

/// All that a study asks for.
struct StudyCost {
    std::map<std::string, double> tasks = {};  ///< by phase
    double cpu_seconds = 0.0;
    double longest = 0.0;  ///< CPU seconds of the tasks that wait for each other
    double bytes = 0.0;
    unsigned workers = 1;  ///< that share the tasks

    /// One task; before: CPU seconds of what it waits for. Returns those with its own.
    double add(const PhaseCost& task, double before);
};
/// For a document without a server, checked or not: repeats, variants (or samples) and transfer
/// times multiplied. 1 for any other document.
StudyCost study_cost_of(const std::vector<PhaseCost>& costs, const nlohmann::json& document);

/// One text line per phase, and their sum.
std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const StudyCost& all);
/// Includes lines_of.
nlohmann::json as_json(const std::vector<PhaseCost>& costs, const StudyCost& all);

}  // namespace breach::estimate
