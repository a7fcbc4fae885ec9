// More transfer times for a run that exists. What was computed stays; the FEM is run again only
// when a snapshot is missing, and then with all times, so that it is the FEM of the whole sweep
// submitted at once (and is found in the cache by such a study).
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

}  // namespace breach::orchestrator
