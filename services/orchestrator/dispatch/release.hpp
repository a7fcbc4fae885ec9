// Releases tasks that waited for a parent, for a parent's file, or for a retry time.
#pragma once

#include <stop_token>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// Releases or skips the tasks that wait for this task, and those that wait for them.
void settle_children(Store& store, const DataFolder& data, const std::string& parent);
/// The same for every task that others wait for.
void settle_all_children(Store& store, const DataFolder& data, const std::stop_token& stop);
void release_due_retries(Store& store);

}  // namespace breach::orchestrator
