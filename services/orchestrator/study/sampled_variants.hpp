// Turns samples into variants, and refuses entries that do not fit an uncertainty study.
#pragma once

#include "services/orchestrator/study/accuracy.hpp"
#include "services/orchestrator/study/samples.hpp"

namespace breach::orchestrator {

/// The phases of each sample: lem_tool alone for factor_of_safety, else all that the scene allows.
/// Unknown quantities are faults. entry: "uncertainty", which the schema has accepted.
Reach reach_of_samples(const nlohmann::json& entry, const nlohmann::json& scene, Reach of_scene,
                       std::vector<fault::Fault>& faults);

/// Faults of overrides that a parameter gives as well, and of a lattice without points.
void check_parameters(const nlohmann::json& document, const UncertaintyPlan& plan, Reach reach,
                      std::vector<fault::Fault>& faults);

/// Turns "transfer" into the study's own transfer_times; a trigger that it names must exist.
void place_transfer(nlohmann::json& document, std::vector<fault::Fault>& faults);

/// Makes the variant this sample; lattice empty: the variant has its own.
void give_sample(const UncertaintyPlan& plan, const DrawnSample& sample,
                 const nlohmann::json& scene, const Lattice& lattice, VariantEntry& entry);

/// The samples so far: "s0001", "s0002", ... scene: completed, with the study's own
/// overrides.
std::vector<VariantEntry> variants_of(const UncertaintyPlan& plan, const nlohmann::json& scene,
                                      Reach reach);

/// Overrides that change one parameter alone: two of its values, or all its options.
struct ParameterProbe {
    std::size_t parameter;
    std::vector<std::vector<std::string>> overrides;
};
std::vector<ParameterProbe> probes_of(const UncertaintyPlan& plan, const nlohmann::json& scene,
                                      Reach reach);

/// Moves faults of the samples' scenes ("/scene/entry: cause") to the parameter that sets the
/// entry, each once.
std::vector<fault::Fault> faults_by_parameter(const std::vector<fault::Fault>& found,
                                              const UncertaintyPlan& plan);

}  // namespace breach::orchestrator
