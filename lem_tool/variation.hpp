// The probability of failure: parameters of the scene varied at random.
// The last part of an analysis. Samples are dealt out by blocks; their values follow from the seed
// alone, in any order.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::lem {

/// Samples of a probabilistic analysis.
struct Samples {
    std::vector<std::string> names;            ///< "cohesion of clay"
    std::vector<std::vector<double>> factors;  ///< [variables][samples] value over mean [-]
    std::vector<double> factor_of_safety;      ///< infinite: no driving moment [-]
};

/// Adds "probability": mean, standard deviation, probability_of_failure, reliability_index. Needs
/// the original scene, not limit_scene's.
Samples add_probability(const scene::Scene& scene, int threads, nlohmann::json& result);

/// Flags that Bishop's factor is varied while another method's is lower.
std::vector<fault::Flag> flags_of_variations(const nlohmann::json& result);

/// One line per sample.
std::string table_of(const Samples& samples);

}  // namespace breach::lem
