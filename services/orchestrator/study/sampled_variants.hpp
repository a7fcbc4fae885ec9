// A study's samples as its variants, and what an uncertainty study cannot ask for.
#pragma once

#include "services/orchestrator/study/accuracy.hpp"
#include "services/orchestrator/study/uncertainty.hpp"

namespace breach::orchestrator {

/// How far the tasks of each sample go: lem_tool alone for factor_of_safety, else what the scene lets
/// be run. A quantity that no result has is a fault. entry: "uncertainty", which the schema has found
/// sound.
Reach reach_of_samples(const nlohmann::json& entry, const nlohmann::json& scene, Reach of_scene,
                       std::vector<fault::Fault>& faults);

/// Variants, draws and overrides that take a parameter's place; accuracy and check.
void check_company_of_samples(const nlohmann::json& document, const UncertaintyPlan& plan,
                              Reach reach, std::vector<fault::Fault>& faults);

/// What "transfer" says, as the study's own transfer_times; a trigger that it names must be there.
void place_transfer(nlohmann::json& document, std::vector<fault::Fault>& faults);

/// The samples that are drawn so far: "s0001", "s0002", ... scene: completed, with the study's own
/// overrides.
std::vector<VariantEntry> variants_of(const UncertaintyPlan& plan, const nlohmann::json& scene,
                                      Reach reach);

/// Changes of the scene that one parameter alone makes: two of its values, or all its options.
struct ParameterProbe {
    std::size_t parameter;
    std::vector<std::vector<std::string>> overrides;
};
std::vector<ParameterProbe> probes_of(const UncertaintyPlan& plan, const nlohmann::json& scene,
                                      Reach reach);

/// Faults that checking the samples' scenes has found ("/scene/entry: cause" at one pointer), each
/// entry's once, at the parameter that sets it.
std::vector<fault::Fault> told_by_parameter(const std::vector<fault::Fault>& found,
                                            const UncertaintyPlan& plan);

}  // namespace breach::orchestrator
