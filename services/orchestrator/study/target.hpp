// The entry "target" of an uncertainty study: varies one parameter until a result has a given
// value, with the other parameters at their medians. core/statistics/inverse.hpp chooses the
// values; this file makes them variants.
#pragma once

#include "core/statistics/inverse.hpp"
#include "services/orchestrator/study/accuracy.hpp"
#include "services/orchestrator/study/uncertainty.hpp"

namespace breach::orchestrator {

struct Target {
    statistics::InverseQuestion question;
    std::size_t parameter;       ///< index of the varied parameter in the plan
    std::size_t lattices = 1;    ///< number of lattices of points for each value
    std::vector<double> values;  ///< so far, in the order of their requests
};

/// entry: "uncertainty" with "target", which the schema has accepted; faults have the study's
/// pointers.
Target read_target(const nlohmann::json& entry, const UncertaintyPlan& plan, Reach reach,
                   std::vector<fault::Fault>& faults);

/// "v01", "v01_d2", ...: each value on each lattice. scene: completed, with the study's overrides.
std::vector<VariantEntry> variants_of(const Target& target, const UncertaintyPlan& plan,
                                      const nlohmann::json& scene, Reach reach);

}  // namespace breach::orchestrator
