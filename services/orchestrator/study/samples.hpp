// The samples of a plan: their values, and the changes of the scene.
#pragma once

#include <functional>

#include "services/orchestrator/study/uncertainty.hpp"

namespace breach::orchestrator {

/// One sample. draws: one number per parameter: the factor or value, rounded to six digits; the
/// index of the option; the number of the lattice.
struct DrawnSample {
    std::size_t number;  ///< from 1
    std::vector<double> draws;
};

/// The first `count` samples of the plan. They depend on its parameters, correlations, seed,
/// sampling and first hypercube, not on the number requested.
std::vector<DrawnSample> samples_of(const UncertaintyPlan& plan, std::size_t count);

/// "s0001"
std::string name_of_sample(std::size_t number);

/// By the parameter's name: the value, the option's name, or the lattice's number.
nlohmann::json values_of(const UncertaintyPlan& plan, const DrawnSample& sample);

/// Changes that move the points to this lattice.
using Lattice = std::function<std::vector<std::string>(std::size_t number)>;

/// Changes of the scene by one value of one parameter. scene: completed, for factors.
std::vector<std::string> overrides_of(const Parameter& parameter, double draw,
                                      const nlohmann::json& scene, const Lattice& lattice);

/// Quantile of the parameter at probability u, 0 < u < 1.
double draw_at(const Parameter& parameter, double u);

}  // namespace breach::orchestrator
