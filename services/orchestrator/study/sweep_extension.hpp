// More transfer times for a run that exists. What was computed stays; the FEM is run again only
// when a snapshot is missing, and then with all times, so that it is the FEM of the whole sweep
// submitted at once (and is found in the cache by such a study).
#pragma once

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// A task that is added to a run: its parent is in the run already, or added before it.
struct AddedTask {
    TaskPlan plan;  ///< its `parent`: place in the list of added tasks
    std::optional<std::string> parent;
};

struct Extension {
    std::vector<double> times;     ///< those that are new
    std::vector<AddedTask> tasks;  ///< parents first
    std::vector<Recipe> recipes;
    nlohmann::json study;  ///< the study's document with all times
};

/// `wanted`: "transfer_times" as in a study, list or range. Throws BadInput.
Extension plan_extension(const Store& store, const DataFolder& data, const std::string& run,
                         const nlohmann::json& wanted);

}  // namespace breach::orchestrator
