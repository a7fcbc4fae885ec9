// Adds transfer times, or samples, to an existing run. Computed results stay. For more times
// the FEM is repeated only when a snapshot is missing, and then with all times, so that it
// equals the FEM of the whole sweep submitted at once (and is found in the cache by such a
// study).
#pragma once

#include "services/orchestrator/files/data_folder.hpp"

namespace breach::orchestrator {

/// A run as it is stored.
struct RunSoFar {
    nlohmann::json study;  ///< without its scene
    std::string scene;     ///< JSON
    std::vector<Task> tasks;
};

/// `wanted`: "transfer_times" as in a study, list or range. Throws BadInput.
Extension plan_extension(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                         const nlohmann::json& wanted);

/// `drawn` samples now exist and `asked` are requested in all, of an uncertainty study: the first
/// stay. Throws BadInput.
Extension plan_more_samples(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            std::size_t drawn, std::size_t asked);

/// The further variants of the study with this entry "uncertainty": samples, or values of an inverse
/// study, after the existing ones. Throws BadInput.
Extension plan_more_variants(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                             const nlohmann::json& entry);

/// Whether variants of different stability analyses share a FEM that this trigger would watch. It needs
/// their critical depth: had the study contained it, they would not. Throws BadInput.
bool shares_fems_too_widely(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            const TriggerPlan& trigger);

}  // namespace breach::orchestrator
