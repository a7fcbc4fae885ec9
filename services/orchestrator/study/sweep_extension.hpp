// Adds transfer times or samples to an existing run. Computed results stay. The FEM is repeated
// only when a snapshot is missing, and then with all times: it then equals the FEM of the whole
// sweep submitted at once, and its cache entry. Plans only: Transaction::extend_run stores it.
#pragma once

#include "services/orchestrator/files/data_folder.hpp"

namespace breach::orchestrator {

struct RunSoFar {
    nlohmann::json study;  ///< without its scene
    std::string scene;     ///< JSON
    std::vector<Task> tasks;
};

/// `wanted`: "transfer_times" as in a study, list or range. Throws BadInput.
Extension plan_extension(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                         const nlohmann::json& wanted);

/// For an uncertainty study: `drawn` samples exist, `asked` are requested in all; the existing ones
/// stay. Throws BadInput.
Extension plan_more_samples(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            std::size_t drawn, std::size_t asked);

/// Adds the variants that the study with this entry "uncertainty" has beyond the existing ones:
/// samples, or values of an inverse study. Throws BadInput.
Extension plan_more_variants(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                             const nlohmann::json& entry);

/// Whether variants with different stability analyses share a FEM that this trigger would watch.
/// The trigger needs one critical depth per FEM. Throws BadInput.
bool shares_fems_too_widely(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            const TriggerPlan& trigger);

}  // namespace breach::orchestrator
