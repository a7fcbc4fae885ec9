// Variation of parameters: one at a time, and all at random.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

// Both take the original scene, not limit_scene's.

/// Adds "sensitivity": F with each strength parameter lower and higher by the scene's share.
void add_sensitivity(const scene::Scene& scene, int threads, nlohmann::json& result);

/// The samples of a probabilistic run, one entry per sample and variable.
struct Samples {
    std::vector<std::string> names;            ///< "cohesion of clay"
    std::vector<std::vector<double>> factors;  ///< by variable: value over mean [-]
    std::vector<double> factor_of_safety;      ///< infinite: nothing drives the mass [-]
};

/// Adds "probability": mean, standard deviation, probability_of_failure, reliability indices.
Samples add_probability(const scene::Scene& scene, int threads, nlohmann::json& result);

/// The varied factor is Bishop's, and the result's own is lower.
std::vector<fault::Flag> flags_of_variations(const nlohmann::json& result);

/// One line per sample.
std::string table_of(const Samples& samples);

}  // namespace breach::lem
