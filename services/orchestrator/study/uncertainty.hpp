// The study's entry "uncertainty": the uncertain settings, their distributions, and the number of
// samples. samples.cpp draws from it, sampled_variants.cpp makes variants of the samples,
// uncertainty/ computes the statistics of the results.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/statistics/distribution.hpp"
#include "core/statistics/rank_correlation.hpp"

namespace breach::orchestrator {

enum class ParameterKind {
    factor,     ///< multiplies the scene's values of its entries
    value,      ///< replaces the values of its entries
    choice,     ///< one of several lists of overrides
    numerical,  ///< the lattice of material points: an uncertainty of the method itself
};
std::string_view name_of(ParameterKind kind);

struct Choice {
    std::string name;
    std::vector<std::string> overrides;
    double weight = 1.0;
};

struct Parameter {
    std::string name;
    ParameterKind kind = ParameterKind::value;
    std::vector<std::string> entries;       ///< pointers into the scene
    statistics::Distribution distribution;  ///< of factor and value
    std::vector<Choice> choices;            ///< of choice
    std::size_t lattices = 1;               ///< of numerical: sampled from those numbered 0, 1, ...
};

enum class Sampling { latin_hypercube, sobol };
std::string_view name_of(Sampling sampling);

/// Spearman's rank correlation between two parameters, by their indices.
struct AskedCorrelation {
    std::size_t a, b;
    double rank;
};

struct UncertaintyPlan {
    std::string quantity;     ///< the quantity shown first
    std::size_t samples = 1;  ///< number requested
    std::size_t drawn = 1;    ///< created so far: fewer than requested with `until`
    std::size_t first = 1;    ///< size of the first hypercube
    std::uint64_t seed = 0;
    Sampling sampling = Sampling::latin_hypercube;
    std::vector<Parameter> parameters;
    std::vector<AskedCorrelation> correlations;
    /// Of "until": samples are added in batches of this size (uncertainty/batch_watch.hpp).
    std::optional<std::size_t> batch;
};

/// The entry, which the schema has accepted; faults have the study's pointers ("/uncertainty/...").
/// `scene`: completed, with the study's own overrides.
UncertaintyPlan read_uncertainty(const nlohmann::json& entry, const nlohmann::json& scene,
                                 std::vector<fault::Fault>& faults);

/// Whether the parameter sets this entry of the scene, a part of it, or an object around it.
bool gives(const Parameter& parameter, const std::string& pointer);

/// The requested rank correlations, 1 on the diagonal, 0 where none is given.
statistics::Matrix correlation_matrix(const UncertaintyPlan& plan);

}  // namespace breach::orchestrator
